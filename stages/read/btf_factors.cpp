// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/btf_factors.h"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace abrdf {

namespace {

constexpr std::uint64_t kHuge = std::uint64_t{1} << 48;

FactorMatrix readMatrix(ByteCursor& file, std::uint64_t rows, std::uint64_t columns,
                        unsigned scalarBytes, const char* what) {
    FactorMatrix matrix;
    matrix.values = file.floats(boundedProduct(rows, columns, kHuge), scalarBytes, what);
    matrix.rows = rows;
    matrix.columns = columns;
    return matrix;
}

/// At least 1, so that no row is without bytes in the file.
std::uint32_t componentCount(ByteCursor& file) {
    const std::uint32_t count = file.u32("component count");
    if (count == 0) file.fail("it declares 0 components");
    return count;
}

}  // namespace

void addProduct(const FactorMatrix& matrix, std::size_t first, std::size_t count,
                std::span<const float> vector, std::span<float> out, std::size_t stride) {
    const auto size = static_cast<Eigen::Index>(matrix.columns);
    const Eigen::Map<const Eigen::VectorXf> factor(vector.data(), size);
    for (std::size_t r = 0; r < count; ++r) {
        const Eigen::Map<const Eigen::VectorXf> row(matrix.row(first + r).data(), size);
        out[stride * r] += row.dot(factor);
    }
}

BtfFactors readBtfFactors(ByteCursor& file, const BtfExtent& extent, std::size_t channels) {
    const auto scalarBytes = file.number<std::uint8_t>("scalar size");
    const std::uint32_t count = componentCount(file);
    const std::uint32_t rowsU = file.u32("factor sizes");
    const std::uint32_t rowsX = file.u32("factor sizes");
    BtfFactors factors;
    if (rowsU == channels * extent.pairs() && rowsX == extent.texels()) {
        factors.imagesAsColumns = false;
    } else if (rowsU == channels * extent.texels() && rowsX == extent.pairs()) {
        factors.imagesAsColumns = true;
    } else {
        file.fail(
            fmt::format("its factors have {} and {} rows, which do not fit {} texels, {} "
                        "direction pairs and {} channels",
                        rowsU, rowsX, extent.texels(), extent.pairs(), channels));
    }
    file.floats(count, scalarBytes, "singular values");  // In X already: not to be applied again.
    FactorMatrix u = readMatrix(file, rowsU, count, scalarBytes, "factors");
    FactorMatrix x = readMatrix(file, rowsX, count, scalarBytes, "factors");
    if (factors.imagesAsColumns) std::swap(u, x);
    factors.pairs = std::move(u);
    factors.texels = std::move(x);
    return factors;
}

void addImage(const BtfFactors& factors, std::size_t a, std::size_t channels, std::span<float> out,
              std::size_t stride) {
    if (factors.imagesAsColumns) {
        addProduct(factors.texels, 0, factors.texels.rows, factors.pairs.row(a), out, stride);
        return;
    }
    for (std::size_t c = 0; c < channels; ++c) {
        addProduct(factors.texels, 0, factors.texels.rows, factors.pairs.row(c + channels * a),
                   out.subspan(stride * c), stride * channels);
    }
}

BtfViewComponents readBtfViewComponents(ByteCursor& file, const BtfExtent& extent) {
    const auto scalarBytes = file.number<std::uint8_t>("scalar size");
    const std::uint32_t count = componentCount(file);
    const std::uint32_t weights = file.u32("weights");
    const std::uint32_t size = file.u32("component size");
    BtfViewComponents view;
    if (size == extent.channels * extent.lights && weights == extent.texels()) {
        view.imagesAsColumns = false;
    } else if (size == extent.channels * extent.texels() && weights == extent.lights) {
        view.imagesAsColumns = true;
    } else {
        file.fail(
            fmt::format("its components of {} values with {} weights do not fit {} texels, "
                        "{} lights and {} channels",
                        size, weights, extent.texels(), extent.lights, extent.channels));
    }
    file.floats(count, scalarBytes, "eigenvalues");  // Not used.
    view.mean = file.floats(size, scalarBytes, "mean");
    view.components = readMatrix(file, size, count, scalarBytes, "components");
    view.weights = readMatrix(file, weights, count, scalarBytes, "weights");
    return view;
}

void decodeImage(const BtfViewComponents& view, const BtfExtent& extent, std::size_t light,
                 std::span<float> out) {
    const std::size_t channels = extent.channels;
    if (view.imagesAsColumns) {
        std::ranges::copy(view.mean, out.begin());
        addProduct(view.components, 0, view.components.rows, view.weights.row(light), out, 1);
        return;
    }
    for (std::size_t c = 0; c < channels; ++c) {
        const std::size_t row = c + channels * light;
        for (std::size_t t = 0; t < extent.texels(); ++t) out[c + channels * t] = view.mean[row];
        addProduct(view.weights, 0, view.weights.rows, view.components.row(row), out.subspan(c),
                   channels);
    }
}

}  // namespace abrdf
