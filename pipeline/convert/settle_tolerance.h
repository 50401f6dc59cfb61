// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/convert/convert_job.h"
#include "stages/slice/slice_texels.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// What the models of a material's texels are, where a tolerance chooses them, by some of its
/// texels: {"tolerance", "of_texels", "within", "ranks": {"constant": 1, "rank 8": 3}, "cost"},
/// cost the mean multiply-adds beside those of whole models. Null without a tolerance. Warns where
/// it is not within reach, and throws std::runtime_error where that is an error
/// (options.limits.strict).
nlohmann::ordered_json settleTolerance(const ConvertJob& job, const ConvertOptions& options,
                                       const Reconstructor& reconstructor,
                                       const TexelSlicer& slicer, const ReadFacts& facts);

}  // namespace abrdf
