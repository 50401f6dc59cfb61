// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/job.h"
#include "stages/slice/slice_texels.h"

#include <nlohmann/json.hpp>

#include <cstddef>

namespace abrdf {

/// How small the models of a material's texels may be for a tolerance, by some of its texels.
struct RankFacts {
    std::size_t texels = 0;        ///< That were looked at.
    std::size_t within = 0;        ///< Whose bound is within the tolerance.
    nlohmann::ordered_json ranks;  ///< How many texels took which: {"constant": 1, "rank 8": 3}.
    double cost = 1;               ///< Mean multiply-adds beside those of whole models.
};

/// images: how many were read. The reconstructor has a model.
RankFacts rankFacts(const Reconstructor& reconstructor, const TexelSlicer& slicer,
                    const ReadFacts& facts, std::size_t images, double tolerance);

nlohmann::ordered_json jsonOf(const RankFacts& facts, double tolerance);

}  // namespace abrdf
