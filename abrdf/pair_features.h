// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// A row a pair: ln(half angle in degrees + 2), difference angle in degrees / 40, theta_i, theta_v
/// in radians. What an isotropic material's value mostly depends on (design: estimator.md, 2.3).
Eigen::MatrixXd isotropicFeatures(std::span<const LightAndView> pairs);

/// A row a pair: the unit vectors to the light and to the viewer.
Eigen::MatrixXd vectorFeatures(std::span<const LightAndView> pairs);

/// |a_i - b_j|^2 for all rows of a and b.
Eigen::MatrixXd squaredDistances(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Pairs, and which of them are one and the same.
struct PairGroups {
    std::vector<LightAndView> distinct;
    std::vector<std::size_t> rowOf;  ///< Of each pair, its place in `distinct`.
};

/// Equal pairs; at the pole an azimuth says nothing (rectangular grids repeat it).
PairGroups distinctPairs(std::span<const LightAndView> pairs);

/// Pairs that are one to every isotropic material: equal theta_i, theta_v and |phi_i - phi_v|.
PairGroups isotropicPairs(std::span<const LightAndView> pairs);

}  // namespace abrdf
