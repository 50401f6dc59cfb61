// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/matrix_product.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace abrdf {

/// A linear map from samples to outputs, whole or through `rank` numbers: U V, V first.
class LowRankMatrix {
  public:
    LowRankMatrix() = default;

    /// rank 0 or not below the number of columns: the matrix itself. Else its best approximation
    /// for vectors of this covariance.
    LowRankMatrix(const Eigen::MatrixXf& matrix, const Eigen::MatrixXd& covariance, int rank);

    std::size_t rows() const { return outputs_.rows(); }
    /// Numbers of a reduced() vector.
    std::size_t vectorSize() const { return outputs_.columns(); }
    std::size_t panels() const { return outputs_.panels(); }

    /// V times each vector (a copy of them at full rank): what multiply() takes.
    std::vector<float> reduced(std::span<const float> vectors) const;

    /// As PackedMatrix::multiply(), of reduced() vectors.
    void multiply(std::span<const float> vectors, std::size_t firstPanel, std::size_t panelCount,
                  float* result, std::size_t stride) const {
        outputs_.multiply(vectors, firstPanel, panelCount, result, stride);
    }

    /// Of one vector.
    double multiplyAdds() const;

  private:
    PackedMatrix samples_;  ///< V; without columns at full rank.
    PackedMatrix outputs_;  ///< U.
};

}  // namespace abrdf
