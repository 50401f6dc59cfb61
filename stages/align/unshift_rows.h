// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/angular_grid.h"
#include "stages/align/shift_image.h"

#include <functional>
#include <vector>

namespace abrdf {

/// How texels were shifted, to be undone.
struct AppliedShifts {
    std::vector<Shift> ofView;  ///< In texels, one a view of the grid.
    Edges edges = Edges::kPeriodic;
    int width = 1;  ///< Texels of the whole map.
    int height = 1;
};

/// Rows of aligned texels that row `y` of the database's frame is made of, ascending, each once.
std::vector<int> alignedRows(const AppliedShifts& applied, int y);

/// One row of texels as the database's images show it: the image of each view shifted back. Past
/// the edge of a cropped map its last texel stands in. alignedRow(y): the ABRDFs of row y, for
/// those that alignedRows() names.
AbrdfTile unshiftedRow(const AppliedShifts& applied, const AngularGrid& grid, int y,
                       const std::function<const AbrdfTile&(int y)>& alignedRow);

}  // namespace abrdf
