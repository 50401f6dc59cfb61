// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"
#include "abrdf/progress.h"
#include "pipeline/read_images.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

/// The full measurement, and what is needed to compare with it.
struct Reference {
    AbrdfTile truth;  ///< All texels, linear Rec.709; NaN where a shifted image has nothing.
    Plane plane;      ///< That its images are shifted to.
    std::vector<std::uint8_t> present;  ///< One flag a pair.

    /// Flags of the pairs to compare: measured ones, without `excluded`.
    std::vector<std::uint8_t> maskWithout(const std::vector<std::size_t>& excluded) const;
};

/// Reads every image of `input`. Throws as readImages() and samplesFor().
Reference readReference(const OpenedInput& input, Texels texels, const Plane& plane,
                        const ProgressSink& progress);

}  // namespace abrdf
