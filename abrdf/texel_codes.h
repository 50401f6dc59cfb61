// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

/// Ranks that stand for more than how many numbers a vector has.
inline constexpr std::uint16_t kConstantRank = 0;   ///< Lambert's law: TexelScale::channel times
                                                    ///< cos(theta_i).
inline constexpr std::uint16_t kIsotropicRank = 2;  ///< The same for all isotropic twins.

/// One texel's numbers beside its vectors.
struct TexelScale {
    float luminance = 0;                ///< Scale of its luminance; 0: the texel is black.
    Rgb channel;                        ///< Of its channels; 0: that channel is black.
    std::array<float, 2> meanChroma{};  ///< Of R and G; all three sum to 3.
};

/// How the parts of a colour come together.
struct TexelRule {
    float cap = 0;    ///< As TexelRows.
    float floor = 0;  ///< As TexelRows.
    float blend = 0;  ///< As TexelRows.

    std::size_t logVectors() const { return blend > 0 ? 4 : 1; }
    std::size_t chromaVectors() const { return blend < 1 ? 2 : 0; }
    std::size_t vectors() const { return logVectors() + chromaVectors(); }
};

/// Texels as the numbers that a TexelModel makes ABRDFs of. A vector has `stride` numbers, those
/// past its texel's rank are 0; vectors of one kind stand one after the other.
struct TexelCodes {
    std::size_t stride = 0;
    std::vector<TexelScale> scales;
    std::vector<std::uint16_t> ranks;
    std::array<std::vector<float>, 4> logs;    ///< Of luminance, R, G and B.
    std::array<std::vector<float>, 2> chroma;  ///< Of R and G, about its mean.

    std::size_t count() const { return scales.size(); }
};

}  // namespace abrdf
