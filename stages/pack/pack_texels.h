// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/angular_grid.h"
#include "abrdf/atlas_layout.h"
#include "color/color_config.h"

#include <cstddef>
#include <vector>

namespace abrdf {

struct PackOptions {
    ColorTransform toOutputSpace;  ///< From scene_linear to the atlas's colour space.
    bool divideCosine = false;     ///< Divide by cos(theta_i); at least cos(89.9 degrees).
};

/// The final values of texels: cosine and colour space applied, in place.
void finishTexels(AbrdfTile& abrdfs, const AngularGrid& grid, const PackOptions& options);

/// A rectangle of atlas pixels, row by row.
struct AtlasBlock {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;
};

/// Whole rows of texels [firstRow, firstRow + rows) in an angular atlas: one rectangle.
/// abrdfs: the texels of these rows, row by row.
AtlasBlock packAngular(const AbrdfTile& abrdfs, const AtlasLayout& layout, int firstRow, int rows);

/// All texels in a spatial atlas.
AtlasBlock packSpatial(const AbrdfTile& abrdfs, const AtlasLayout& layout);

}  // namespace abrdf
