// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace abrdf {

/// Thin-plate radial basis functions r^2 ln r with a linear polynomial in the plane
/// (theta_i, theta_v): the weights by which values at the nodes make the value anywhere.
/// Solved once; they depend on places only, never on values.
class RbfWeights {
  public:
    /// nodes: one a row, at least 3, not on one line; throws std::invalid_argument where the system
    /// is singular (reciprocal condition number below 1e-10).
    explicit RbfWeights(const Eigen::MatrixX2d& nodes);

    /// One weight a node; they sum to 1, and reproduce values at nodes and linear functions.
    Eigen::VectorXd at(const Eigen::RowVector2d& place) const;

    double condition() const { return condition_; }

  private:
    Eigen::RowVectorXd basis(const Eigen::RowVector2d& place) const;

    Eigen::MatrixX2d nodes_;
    Eigen::MatrixXd inverse_;
    double condition_ = 1;
};

}  // namespace abrdf
