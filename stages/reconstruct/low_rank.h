// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace abrdf {

/// A linear map of vectors as basis . projection, the columns of the basis by falling worth: of
/// all maps through r numbers, the first r columns and rows are the best one for vectors of a given
/// covariance.
struct NestedBasis {
    Eigen::MatrixXf basis;       ///< Output, number.
    Eigen::MatrixXf projection;  ///< Number, input.
};

/// rank: how many numbers, 1 .. inputs; with all of them the map itself comes out, but for
/// rounding. weights: how much each output matters; empty: all alike.
NestedBasis nestedBasis(const Eigen::MatrixXf& matrix, const Eigen::MatrixXd& covariance, int rank,
                        const Eigen::VectorXd& weights = {});

}  // namespace abrdf
