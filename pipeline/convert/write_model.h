// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/transposed_table.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/written_atlas.h"
#include "stages/slice/slice_texels.h"

namespace abrdf {

/// Makes and writes a model atlas of all texels of a table (rows images, columns texels row by
/// row); its type is that of the coefficients. Throws std::runtime_error where the method has no
/// model.
WrittenAtlas writeModel(const ConvertJob& job, const ConvertOptions& options,
                        const TransposedTable& table, const TexelSlicer& slicer,
                        const Reconstructor& reconstructor, const ProgressSink& progress);

}  // namespace abrdf
