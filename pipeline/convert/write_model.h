// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/transposed_table.h"
#include "pipeline/convert/convert_job.h"
#include "stages/slice/slice_texels.h"

#include <cstdint>
#include <vector>

namespace abrdf {

struct WrittenModel {
    std::uint64_t bytes = 0;
    PixelType type = PixelType::kFloat;  ///< Of the coefficients.
    std::vector<float> estimates;        ///< A bound of each texel's mean Delta E.
};

/// Makes and writes a model atlas of all texels of a table (rows images, columns texels row by
/// row). Throws std::runtime_error where the method has no model.
WrittenModel writeModel(const ConvertJob& job, const ConvertOptions& options,
                        const TransposedTable& table, const TexelSlicer& slicer,
                        const Reconstructor& reconstructor, const ProgressSink& progress);

}  // namespace abrdf
