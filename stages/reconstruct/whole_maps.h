// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "abrdf/texel_model.h"
#include "stages/reconstruct/prior_encoder.h"
#include "stages/reconstruct/prior_fit.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// The maps from a material's samples to the outputs, of vectors with a number a sample (whole
/// codes).
struct WholeMaps {
    Eigen::MatrixXf luminance;       ///< Row, sample.
    Eigen::MatrixXf chroma;          ///< The same.
    TexelBasis centers;              ///< What the rows' centres become; its matrices are empty.
    std::vector<std::size_t> rowOf;  ///< Of each pair, its row.
    std::vector<LightAndView> pairs;

    /// The centres with matrices of this many rows, and any columns.
    TexelBasis basisOf(const Eigen::MatrixXf& ofLuminance, const Eigen::MatrixXf& ofChroma) const;
};

/// centers: of the codes; rowOf: of each output, its place among the model's, which are distinct.
/// Isotropic twins share a row where the fit cannot tell them apart. onlyCenters: no vector but 0
/// will be mapped: the matrices have one column of zeros; far cheaper.
WholeMaps wholeMaps(const PriorModel& model, const PriorFit& fit,
                    const PriorEncoder::Centers& centers, std::span<const std::size_t> rowOf,
                    bool onlyCenters);

/// What the samples say of one another when each is left out (leaveOutBlocks()), as a model of
/// whole codes whose pairs are the samples.
TexelModel leaveOutModel(const PriorModel& model, const PriorFit& fit,
                         const PriorEncoder::Centers& centers);

}  // namespace abrdf
