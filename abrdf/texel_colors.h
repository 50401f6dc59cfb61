// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <array>
#include <cstddef>

namespace abrdf {

/// What the prior's products say of some rows (outputs) of one texel: log luminance, and chroma by
/// kriging, by channels that are estimated like luminance, or a blend of both. A product gets its
/// centre added. Pointers of a part without a share in the blend may be null.
struct TexelRows {
    std::array<const float*, 4> logs{};  ///< Of luminance, R, G and B; a number a row.
    std::array<const float*, 4> logCenters{};
    std::array<const float*, 2> chroma{};  ///< Of R and G, about the samples' mean.
    std::array<const float*, 2> chromaCenters{};
    std::array<float, 2> meanChroma{};
    float luminance = 0;  ///< Scale of the texel's luminance.
    Rgb channel;          ///< Of its channels; 0: that channel is black.
    float cap = 0;        ///< Of the logs.
    float floor = 0;      ///< Taken off their exponentials, which are then at least 0.
    float blend = 0;      ///< Share of chroma from channels, 0 .. 1.
};

/// The colours of `count` rows, with the widest registers of the processor; the same bits on each.
void texelColors(const TexelRows& rows, std::size_t count, Rgb* colors);

/// One of them as the equations say it.
Rgb slowTexelColor(const TexelRows& rows, std::size_t row);

}  // namespace abrdf
