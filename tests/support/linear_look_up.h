// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_interpolation.h"
#include "abrdf/atlas.h"

namespace abrdf {

/// A texel's value with light and view interpolated linearly, each for itself: what integrals over
/// lights use, as it can be summed light by light. The slow twin of previews and pages.
inline Rgb linearLookUp(const Atlas& atlas, Direction light, Direction view) {
    const AngularGrid& grid = atlas.header().grid;
    const DirectionWeights lights = AngularInterpolation(grid.lights()).weights(light);
    const DirectionWeights views = AngularInterpolation(grid.views()).weights(view);
    Rgb sum;
    for (const auto& l : lights.terms) {
        for (const auto& v : views.terms) {
            sum += static_cast<float>(l.weight * v.weight) *
                   atlas.at({0, 0, static_cast<int>(l.index), static_cast<int>(v.index)});
        }
    }
    return sum;
}

}  // namespace abrdf
