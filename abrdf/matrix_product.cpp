// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/matrix_product.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/register_bytes.h"

#include <algorithm>
#include <cassert>

namespace abrdf {

namespace {

constexpr std::size_t kPanel = PackedMatrix::kPanel;

/// One register of a processor, of so many bytes, and the same where memory holds it.
template <typename Number, std::size_t kBytes>
struct Register {
    using Type [[gnu::vector_size(kBytes)]] = Number;
    using Stored [[gnu::vector_size(kBytes), gnu::aligned(sizeof(Number)), gnu::may_alias]] =
        Number;
};

/// Panels of one matrix and the vectors to multiply them with.
template <typename Number>
struct Work {
    const Number* panels;
    std::size_t panelCount;
    std::size_t panelColumns;  ///< That a panel holds ...
    std::size_t columns;       ///< ... and of which these are used, the first.
    const Number* vectors;
    std::size_t vectorCount;
    Number* result;
    std::size_t stride;
};

/// Some rows of a panel times `kVectors` vectors: the sums stay in registers, a column of the rows
/// is loaded once for all vectors.
template <typename Number, std::size_t kBytes, std::size_t kRows, std::size_t kVectors>
[[gnu::always_inline]] inline void multiplyRows(const Number* rows, std::size_t columns,
                                                const Number* vectors, Number* result,
                                                std::size_t stride) {
    using Value = typename Register<Number, kBytes>::Type;
    using Stored = typename Register<Number, kBytes>::Stored;
    constexpr std::size_t kLane = kBytes / sizeof(Number);
    constexpr std::size_t kParts = kRows * sizeof(Number) / kBytes;
    Value sums[kVectors][kParts] = {};
    for (std::size_t k = 0; k < columns; ++k) {
        Value column[kParts];
        for (std::size_t p = 0; p < kParts; ++p) {
            column[p] = *reinterpret_cast<const Stored*>(rows + k * kPanel + p * kLane);
        }
        for (std::size_t v = 0; v < kVectors; ++v) {
            const Number factor = vectors[v * columns + k];
            for (std::size_t p = 0; p < kParts; ++p) sums[v][p] += column[p] * factor;
        }
    }
    // Each by itself: after a memcpy() of all, gcc keeps the sums in memory, and stores them at
    // every step.
    for (std::size_t v = 0; v < kVectors; ++v) {
        for (std::size_t p = 0; p < kParts; ++p) {
            *reinterpret_cast<Stored*>(result + v * stride + p * kLane) = sums[v][p];
        }
    }
}

template <typename Number, std::size_t kBytes, std::size_t kVectors>
[[gnu::always_inline]] inline void multiplyAll(const Work<Number>& w) {
    // Two columns of registers for doubles where floats have one: half the rows at once.
    constexpr std::size_t kRows = kPanel * sizeof(float) / sizeof(Number);
    for (std::size_t p = 0; p < w.panelCount; ++p) {
        const Number* panel = w.panels + p * w.panelColumns * kPanel;
        Number* result = w.result + p * kPanel;
        for (std::size_t row = 0; row < kPanel; row += kRows) {
            std::size_t v = 0;
            for (; v + kVectors <= w.vectorCount; v += kVectors) {
                multiplyRows<Number, kBytes, kRows, kVectors>(
                    panel + row, w.columns, w.vectors + v * w.columns, result + v * w.stride + row,
                    w.stride);
            }
            for (; v < w.vectorCount; ++v) {
                multiplyRows<Number, kBytes, kRows, 1>(panel + row, w.columns,
                                                       w.vectors + v * w.columns,
                                                       result + v * w.stride + row, w.stride);
            }
        }
    }
}

// As many sums as a processor's registers hold, beside the panel's column.
template <typename Number>
[[gnu::target("avx512f")]] void multiplyAvx512(const Work<Number>& work) {
    multiplyAll<Number, 64, 8>(work);
}
template <typename Number>
[[gnu::target("avx2")]] void multiplyAvx2(const Work<Number>& work) {
    multiplyAll<Number, 32, 3>(work);
}
template <typename Number>
void multiplyPortable(const Work<Number>& work) {
    multiplyAll<Number, 16, 1>(work);
}

template <typename Number>
void multiplyFastest(const Work<Number>& work) {
    forRegisters(multiplyAvx512<Number>, multiplyAvx2<Number>, multiplyPortable<Number>)(work);
}

template <typename Number>
Eigen::MatrixX<Number> parallelProduct(const Eigen::MatrixX<Number>& a,
                                       const Eigen::MatrixX<Number>& b) {
    assert(a.cols() == b.rows());
    const BasicPackedMatrix<Number> packed(a);
    const std::size_t stride = packed.panels() * kPanel;
    Eigen::MatrixX<Number> padded(static_cast<Eigen::Index>(stride), b.cols());
    constexpr std::size_t kPanels = 8;
    forEachTexelBlock(packed.panels(), kPanels, [&](std::size_t begin, std::size_t end) {
        packed.multiply({b.data(), static_cast<std::size_t>(b.size())}, begin, end - begin,
                        padded.data() + begin * kPanel, stride);
    });
    return padded.topRows(a.rows());
}

}  // namespace

template <typename Number>
BasicPackedMatrix<Number>::BasicPackedMatrix(const Eigen::MatrixX<Number>& matrix)
    : rows_(static_cast<std::size_t>(matrix.rows())),
      columns_(static_cast<std::size_t>(matrix.cols())),
      values_(panels() * kPanel * columns_) {
    for (std::size_t k = 0; k < columns_; ++k) {
        const Number* column = matrix.data() + k * rows_;
        for (std::size_t p = 0; p < panels(); ++p) {
            const std::size_t count = std::min(kPanel, rows_ - p * kPanel);
            std::copy_n(column + p * kPanel, count, &values_[(p * columns_ + k) * kPanel]);
        }
    }
}

template <typename Number>
void BasicPackedMatrix<Number>::multiplyFirst(std::size_t columns, std::span<const Number> vectors,
                                              std::size_t firstPanel, std::size_t panelCount,
                                              Number* result, std::size_t stride) const {
    assert(columns > 0 && columns <= columns_ && vectors.size() % columns == 0 &&
           firstPanel + panelCount <= panels());
    multiplyFastest<Number>({values_.data() + firstPanel * columns_ * kPanel, panelCount, columns_,
                             columns, vectors.data(), vectors.size() / columns, result, stride});
}

template class BasicPackedMatrix<float>;
template class BasicPackedMatrix<double>;

Eigen::MatrixXf product(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
    return parallelProduct<float>(a, b);
}

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return parallelProduct<double>(a, b);
}

}  // namespace abrdf
