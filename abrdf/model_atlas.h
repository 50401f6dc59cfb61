// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"
#include "abrdf/packed_codes.h"
#include "abrdf/pair_interpolation.h"
#include "abrdf/real_light.h"
#include "abrdf/texel_model.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// An atlas as few numbers a texel and a basis that all share, in scene_linear, over the measured
/// elevations.
struct ModelAtlas {
    AtlasHeader header;  ///< Of kind kModel.
    TexelModel model;
    PackedCodes texels;            ///< Row by row.
    std::vector<float> most;       ///< What no value of a texel exceeds.
    std::vector<float> estimates;  ///< A bound of each texel's mean Delta E; may be empty.
};

/// All pairs of some texels, texel after texel, of `model`, which is the atlas's or a part of it:
/// finite, not negative, and at most `most`. Counts the values that were not.
UnrealCounts evaluateTexels(const ModelAtlas& atlas, const TexelModel& model,
                            std::span<const std::size_t> texels, std::span<Rgb> abrdfs);

/// begin, begin + 1 ... end - 1.
std::vector<std::size_t> texelRange(std::size_t begin, std::size_t end);

/// All of it as an angular atlas in memory.
Atlas expanded(const ModelAtlas& atlas);

/// B(light, view) of a texel; `interpolation`: of the header's grid. Exact at the atlas's
/// directions, interpolated between them, held past the last elevation. Throws std::out_of_range
/// for a texel that is not in the atlas.
Rgb lookUp(const ModelAtlas& atlas, const PairInterpolation& interpolation, Direction light,
           Direction view, int texelX, int texelY);

}  // namespace abrdf
