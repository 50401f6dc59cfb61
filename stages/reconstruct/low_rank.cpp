// SPDX-License-Identifier: BSD-3-Clause
//
// With z = L e, e white, and the singular values of M L = U S V': M z = (M L V) (V' L^-1 z). The
// numbers V' L^-1 z are white, and column k of M L V has the length S_k. Where outputs have weights
// w, it is diag(sqrt(w)) M L whose V are taken.
#include "stages/reconstruct/low_rank.h"

#include "abrdf/matrix_product.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace abrdf {

NestedBasis nestedBasis(const Eigen::MatrixXf& matrix, const Eigen::MatrixXd& covariance, int rank,
                        const Eigen::VectorXd& weights) {
    const Eigen::MatrixXd root = covariance.llt().matrixL();
    const Eigen::MatrixXf colored = product(matrix, root.cast<float>());
    Eigen::MatrixXf weighted = colored;
    if (weights.size() > 0) {
        weighted = weights.cast<float>().asDiagonal() * colored;
    }
    const Eigen::MatrixXd gram =
        product(Eigen::MatrixXf(colored.transpose()), weighted).cast<double>();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    const Eigen::MatrixXd directions = solver.eigenvectors().rowwise().reverse().leftCols(rank);
    const Eigen::MatrixXd inverse =
        root.transpose().triangularView<Eigen::Upper>().solve(directions);
    return {product(colored, directions.cast<float>()), inverse.transpose().cast<float>()};
}

}  // namespace abrdf
