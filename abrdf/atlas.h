// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/pair_interpolation.h"
#include "color/rgb.h"

#include <vector>

namespace abrdf {

/// An atlas in memory, ready for look-ups.
class Atlas {
  public:
    /// pixels: row by row, width x height of the layout; fewer throw std::invalid_argument.
    Atlas(AtlasHeader header, std::vector<Rgb> pixels);

    const AtlasHeader& header() const { return header_; }

    /// Row by row, as the layout says.
    const std::vector<Rgb>& pixels() const { return pixels_; }

    /// The stored value.
    Rgb at(const AtlasSample& sample) const;

    /// Interpolation between the atlas's own light and view directions.
    std::vector<WeightedPair> weights(Direction light, Direction view) const;

  private:
    AtlasHeader header_;
    std::vector<Rgb> pixels_;
    PairInterpolation interpolation_;
};

/// The average of all texels: an atlas of one. Values that are not finite are left out; a pair that
/// has no other is NaN.
Atlas meanOverTexels(const Atlas& atlas);

/// B(light, view) of a texel: exact at the atlas's directions, interpolated between them, held
/// past the last elevation. Throws std::out_of_range for a texel that is not in the atlas.
Rgb lookUp(const Atlas& atlas, Direction light, Direction view, int texelX, int texelY);

}  // namespace abrdf
