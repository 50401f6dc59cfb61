// SPDX-License-Identifier: BSD-3-Clause
//
// With z = L e, e white, and the singular values of M L = U S V': M z = (M L V) (V' L^-1 z). The
// numbers V' L^-1 z are white, and column k of M L V has the length S_k.
#include "stages/reconstruct/low_rank.h"

#include "abrdf/matrix_product.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace abrdf {

NestedBasis nestedBasis(const Eigen::MatrixXf& matrix, const Eigen::MatrixXd& covariance,
                        int rank) {
    const Eigen::MatrixXd root = covariance.llt().matrixL();
    const Eigen::MatrixXf colored = product(matrix, root.cast<float>());
    const Eigen::MatrixXd gram =
        product(Eigen::MatrixXf(colored.transpose()), colored).cast<double>();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    const Eigen::MatrixXd directions = solver.eigenvectors().rowwise().reverse().leftCols(rank);
    const Eigen::MatrixXd inverse =
        root.transpose().triangularView<Eigen::Upper>().solve(directions);
    return {product(colored, directions.cast<float>()), inverse.transpose().cast<float>()};
}

}  // namespace abrdf
