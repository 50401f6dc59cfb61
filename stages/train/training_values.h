// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/analytic_material.h"
#include "abrdf/direction.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace abrdf {

/// Unit vectors of pairs, for PreparedMaterial.
std::vector<VectorPair> vectorPairs(std::span<const LightAndView> pairs);

/// A column a material: its values at the pairs. In parallel.
Eigen::MatrixXf valuesOf(std::span<const PreparedMaterial> materials,
                         std::span<const VectorPair> pairs);

/// The values of one.
Eigen::VectorXd valuesOf(const PreparedMaterial& material, std::span<const VectorPair> pairs);

/// The q-quantile of each column, interpolated between ranks.
Eigen::VectorXd quantileOfColumns(const Eigen::MatrixXf& values, double q);

}  // namespace abrdf
