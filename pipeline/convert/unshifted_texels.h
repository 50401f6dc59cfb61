// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/read_images.h"
#include "stages/align/unshift_rows.h"
#include "stages/reconstruct/reconstructor.h"

#include <functional>
#include <map>

namespace abrdf {

/// Rows of texels in the database's own frame, made of aligned ones that are reconstructed as they
/// are needed and dropped when they are not. Rows are asked for in ascending order.
class UnshiftedTexels {
  public:
    /// reconstruct(first, count): aligned rows of texels.
    using ReconstructRows = std::function<ReconstructedTexels(int first, int count)>;

    /// grid: of the ABRDFs; the database's images have the size that `description` says.
    UnshiftedTexels(const Plane& plane, const BtfDescription& description, Texels texels,
                    const AngularGrid& grid, ReconstructRows reconstruct);

    /// Counts are those of the rows that had to be reconstructed for it.
    ReconstructedTexels rows(int first, int count);

  private:
    AngularGrid grid_;
    AppliedShifts applied_;
    ReconstructRows reconstruct_;
    std::map<int, AbrdfTile> aligned_;  ///< A row each.
};

}  // namespace abrdf
