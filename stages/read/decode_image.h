// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"

#include <span>
#include <string>

namespace abrdf {

/// True where OpenImageIO reads files with this name's extension (in any case).
bool isImageName(const std::string& name);

/// Decodes a whole image from memory; grey becomes RGB, alpha and further channels are left out.
/// `name` tells the format by its extension and stands in messages.
/// Throws std::runtime_error for anything that is not a whole image.
EncodedImage decodeImage(std::span<const char> bytes, const std::string& name);

/// Throws std::runtime_error for a size that no photograph of a material has, before memory is
/// taken for it.
void checkImageSize(int width, int height, const std::string& name);

/// True where the format's values are linear already (OpenEXR, Radiance HDR, PFM).
bool isLinearFormat(const std::string& name);

}  // namespace abrdf
