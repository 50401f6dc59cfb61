// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/low_rank.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>

namespace abrdf {

LowRankMatrix::LowRankMatrix(const Eigen::MatrixXf& matrix, const Eigen::MatrixXd& covariance,
                             int rank) {
    if (rank <= 0 || rank >= matrix.cols()) {
        outputs_ = PackedMatrix(matrix);
        return;
    }
    // With z = L e, e white, M z = (M L) e: the best subspace of outputs is spanned by the first
    // left singular vectors U of M L, and M becomes U (U' M).
    const Eigen::MatrixXd root = covariance.llt().matrixL();
    const Eigen::MatrixXf colored = product(matrix, root.cast<float>());
    const Eigen::MatrixXd gram =
        product(Eigen::MatrixXf(colored.transpose()), colored).cast<double>();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram);
    const Eigen::Index r = rank;
    const Eigen::VectorXd scale =
        solver.eigenvalues().tail(r).cwiseMax(1e-12 * solver.eigenvalues().maxCoeff());
    const Eigen::MatrixXd directions =
        solver.eigenvectors().rightCols(r) * scale.cwiseSqrt().cwiseInverse().asDiagonal();
    const Eigen::MatrixXf basis = product(colored, directions.cast<float>());
    outputs_ = PackedMatrix(basis);
    samples_ = PackedMatrix(product(Eigen::MatrixXf(basis.transpose()), matrix));
}

std::vector<float> LowRankMatrix::reduced(std::span<const float> vectors) const {
    if (samples_.columns() == 0) return {vectors.begin(), vectors.end()};
    const std::size_t count = vectors.size() / samples_.columns();
    const std::size_t stride = samples_.panels() * PackedMatrix::kPanel;
    std::vector<float> padded(count * stride);
    samples_.multiply(vectors, 0, samples_.panels(), padded.data(), stride);
    std::vector<float> result;
    for (std::size_t v = 0; v < count; ++v) {
        const auto begin = padded.begin() + static_cast<std::ptrdiff_t>(v * stride);
        result.insert(result.end(), begin, begin + static_cast<std::ptrdiff_t>(samples_.rows()));
    }
    return result;
}

double LowRankMatrix::multiplyAdds() const {
    return static_cast<double>(samples_.rows() * samples_.columns() +
                               outputs_.rows() * outputs_.columns());
}

}  // namespace abrdf
