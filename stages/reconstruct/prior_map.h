// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "stages/reconstruct/prior_choice.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace abrdf {

/// The mixture of a material as one linear map of logarithms: x = offset + matrix z, a row an
/// output (of `rows`).
struct PriorMap {
    Eigen::VectorXf offset;
    Eigen::MatrixXf matrix;
};

/// True where every term is of class iso, so that isotropic twins among the outputs have one row.
bool isIsotropic(const PriorModel& model, const std::vector<PriorTerm>& terms);

/// outputs: the model's, or the distinct isotropic ones where isIsotropic(). rowOf: of each of the
/// model's outputs, its distinct isotropic one. vectors: where only these are to be mapped, a
/// column each, `matrix` is what it would make of them; far cheaper than the map.
PriorMap priorMap(const PriorModel& model, const std::vector<PriorTerm>& terms,
                  const std::vector<LightAndView>& outputs, std::span<const std::size_t> rowOf,
                  const Eigen::MatrixXd* vectors = nullptr);

}  // namespace abrdf
