// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/texel_model.h"

#include <cstddef>
#include <string>
#include <vector>

namespace abrdf {

// How a model atlas's file names what it holds.
inline constexpr const char* kModelCap = "abrdf:modelCap";              ///< TexelRule::cap.
inline constexpr const char* kModelFloor = "abrdf:modelFloor";          ///< TexelRule::floor.
inline constexpr const char* kModelBlend = "abrdf:modelBlend";          ///< TexelRule::blend.
inline constexpr const char* kModelIsotropic = "abrdf:modelIsotropic";  ///< 1: rank 2 is isotropic.

inline constexpr const char* kTexelsPart = "texels";
inline constexpr const char* kCoefficientsPart = "coefficients";
inline constexpr const char* kLuminancePart = "luminance";
inline constexpr const char* kChromaPart = "chroma";
inline constexpr const char* kWholeLuminancePart = "luminance.whole";
inline constexpr const char* kWholeChromaPart = "chroma.whole";
inline constexpr const char* kCentersPart = "centers";
inline constexpr const char* kRowsPart = "rows";
inline constexpr const char* kBasisChannel = "Y";

/// The vectors that have a share, in the order of PackedCodes::number().
std::vector<std::string> vectorNames(const TexelRule& rule);

/// "Y.003".
std::string coefficientName(const std::string& vector, std::size_t k);

}  // namespace abrdf
