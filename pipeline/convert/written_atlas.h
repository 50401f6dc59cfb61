// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/pixel_type.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

/// What came of writing an atlas, whichever way its texels were made.
struct WrittenAtlas {
    ValueCounts counts;
    std::uint64_t dimmed = 0;  ///< As UnrealCounts.
    PixelType type = PixelType::kHalf;
    std::uint64_t bytes = 0;            ///< Of the file.
    std::size_t resumedTiles = 0;       ///< That an earlier run had written.
    double writeSeconds = 0;            ///< 0 where writing is no phase of its own.
    std::vector<float> estimates = {};  ///< Delta E a texel; none where the method knows none.
};

}  // namespace abrdf
