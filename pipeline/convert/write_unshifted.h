// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/image_stack.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/texel_maker.h"
#include "pipeline/convert/written_atlas.h"

namespace abrdf {

/// Throws std::invalid_argument where options.memory does not hold all samples and the rows that
/// are made at once: asked before the images are read.
void checkUnshiftedMemory(const ConvertJob& job, const ConvertOptions& options);

/// Writes an atlas in the database's own frame: each view of a texel comes from another aligned
/// texel, so that rows go through memory one after the other, and `aligned` holds all samples.
/// Begins anew as float where a half cannot hold a value and options.pixel is kAuto.
WrittenAtlas writeUnshifted(const ConvertJob& job, const ConvertOptions& options,
                            const ImageStack& aligned, const TexelMaker& maker,
                            const ProgressSink& progress);

}  // namespace abrdf
