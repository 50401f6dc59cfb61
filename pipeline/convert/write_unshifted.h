// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/image_stack.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/texel_maker.h"

#include <cstdint>

namespace abrdf {

struct UnshiftedAtlas {
    ValueCounts counts;
    std::uint64_t dimmed = 0;  ///< As UnrealCounts.
    PixelType type = PixelType::kHalf;
    std::uint64_t bytes = 0;
};

/// Writes an atlas in the database's own frame: each view of a texel comes from another aligned
/// texel, so that rows go through memory one after the other, and `aligned` holds all samples.
/// Begins anew as float where a half cannot hold a value and options.pixel is kAuto.
UnshiftedAtlas writeUnshifted(const ConvertJob& job, const ConvertOptions& options,
                              const ImageStack& aligned, const TexelMaker& maker,
                              const ProgressSink& progress);

}  // namespace abrdf
