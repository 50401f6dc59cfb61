// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/rbf_weights.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace abrdf {

RbfWeights::RbfWeights(const Eigen::MatrixX2d& nodes) : nodes_(nodes) {
    //  [ Phi  P ] [ lambda ]   [ values ]
    //  [ P'   0 ] [   c    ] = [   0    ],   P = (1, theta_i, theta_v)
    const Eigen::Index n = nodes_.rows();
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
    for (Eigen::Index i = 0; i < n; ++i) system.row(i) = basis(nodes_.row(i));
    system.bottomLeftCorner(3, n) = system.topRightCorner(n, 3).transpose();
    const Eigen::FullPivLU<Eigen::MatrixXd> lu(system);
    if (!lu.isInvertible() || !(lu.rcond() >= 1e-10)) {
        throw std::invalid_argument(fmt::format(
            "the elevations of the plan lie on one line, so that the missing subspaces cannot be "
            "interpolated (reciprocal condition number {:.1e}, at least 1e-10 is needed); choose "
            "two different elevations",
            lu.rcond()));
    }
    inverse_ = lu.inverse();
    condition_ = 1 / lu.rcond();
}

Eigen::RowVectorXd RbfWeights::basis(const Eigen::RowVector2d& place) const {
    const Eigen::Index n = nodes_.rows();
    Eigen::RowVectorXd row(n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double r2 = (nodes_.row(i) - place).squaredNorm();
        row(i) = r2 > 0 ? 0.5 * r2 * std::log(r2) : 0;
    }
    row.tail(3) << 1, place(0), place(1);
    return row;
}

Eigen::VectorXd RbfWeights::at(const Eigen::RowVector2d& place) const {
    return (basis(place) * inverse_).head(nodes_.rows()).transpose();
}

}  // namespace abrdf
