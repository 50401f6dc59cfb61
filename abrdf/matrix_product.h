// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/zeroed_vector.h"

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace abrdf {

/// A matrix that many vectors are multiplied with, packed once in panels of 32 rows so that a
/// product streams through it. Every sum runs over the columns in their order, without fused
/// multiply-adds: the same bits on every processor, for any number of vectors and threads.
/// (Neither holds for a BLAS, nor for Eigen compiled for one kind of processor.)
/// Number: float or double.
template <typename Number>
class BasicPackedMatrix {
  public:
    static constexpr std::size_t kPanel = 32;

    BasicPackedMatrix() = default;
    explicit BasicPackedMatrix(const Eigen::MatrixX<Number>& matrix);

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    std::size_t panels() const { return (rows_ + kPanel - 1) / kPanel; }

    /// result[v * stride + i] = row (32 firstPanel + i) . vector v, for i below 32 panels (rows
    /// past the last are 0) and all vectors, which stand one after the other, columns() values
    /// each.
    void multiply(std::span<const Number> vectors, std::size_t firstPanel, std::size_t panels,
                  Number* result, std::size_t stride) const {
        multiplyFirst(columns_, vectors, firstPanel, panels, result, stride);
    }

    /// The same of the first `columns` columns alone: that many values a vector, at least one.
    void multiplyFirst(std::size_t columns, std::span<const Number> vectors, std::size_t firstPanel,
                       std::size_t panels, Number* result, std::size_t stride) const;

    /// One number.
    Number at(std::size_t row, std::size_t column) const {
        return values_[(row / kPanel * columns_ + column) * kPanel + row % kPanel];
    }

  private:
    std::size_t rows_ = 0;
    std::size_t columns_ = 0;
    ZeroedVector<Number> values_;  ///< Panel after panel, in each column after column.
};

using PackedMatrix = BasicPackedMatrix<float>;

/// A B, computed as above, in parallel.
Eigen::MatrixXf product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b);
Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace abrdf
