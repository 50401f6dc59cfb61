// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_basis.h"

#include <Eigen/Core>

namespace abrdf {

namespace {

/// The rows of `matrix` at these places.
PackedMatrix at(const PackedMatrix& matrix, std::span<const std::size_t> places) {
    Eigen::MatrixXf result(static_cast<Eigen::Index>(places.size()),
                           static_cast<Eigen::Index>(matrix.columns()));
    for (std::size_t k = 0; k < matrix.columns(); ++k) {
        for (std::size_t i = 0; i < places.size(); ++i) {
            result(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
                matrix.at(places[i], k);
        }
    }
    return PackedMatrix(result);
}

std::vector<float> at(const std::vector<float>& values, std::span<const std::size_t> places) {
    std::vector<float> result;
    for (std::size_t i = 0; i < places.size() && !values.empty(); ++i) {
        result.push_back(values[places[i]]);
    }
    return result;
}

/// Rows of the result are means of the rows of `matrix` that share a group.
PackedMatrix meansOf(const PackedMatrix& matrix, std::span<const std::size_t> groupOf,
                     std::size_t groups, std::size_t columns) {
    Eigen::MatrixXf sums = Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(groups),
                                                 static_cast<Eigen::Index>(columns));
    Eigen::VectorXf counts = Eigen::VectorXf::Zero(sums.rows());
    for (std::size_t row = 0; row < groupOf.size(); ++row) {
        const auto group = static_cast<Eigen::Index>(groupOf[row]);
        counts(group) += 1;
        for (std::size_t k = 0; k < columns; ++k) {
            sums(group, static_cast<Eigen::Index>(k)) += matrix.at(row, k);
        }
    }
    return PackedMatrix(counts.cwiseInverse().asDiagonal() * sums);
}

std::vector<float> meansOf(const std::vector<float>& values, std::span<const std::size_t> groupOf,
                           std::size_t groups) {
    if (values.empty()) return {};
    std::vector<float> sums(groups);
    std::vector<float> counts(groups);
    for (std::size_t row = 0; row < groupOf.size(); ++row) {
        sums[groupOf[row]] += values[row];
        counts[groupOf[row]] += 1;
    }
    for (std::size_t g = 0; g < groups; ++g) sums[g] /= counts[g];
    return sums;
}

}  // namespace

TexelBasis TexelBasis::atRows(std::span<const std::size_t> places) const {
    TexelBasis basis;
    basis.luminance = at(luminance, places);
    basis.chroma = at(chroma, places);
    for (std::size_t i = 0; i < 4; ++i) basis.logCenters[i] = at(logCenters[i], places);
    for (std::size_t c = 0; c < 2; ++c) basis.chromaCenters[c] = at(chromaCenters[c], places);
    return basis;
}

TexelBasis TexelBasis::groupMeans(std::span<const std::size_t> groupOf, std::size_t groups,
                                  std::size_t columns) const {
    TexelBasis basis;
    basis.luminance = meansOf(luminance, groupOf, groups, columns);
    basis.chroma = meansOf(chroma, groupOf, groups, columns);
    for (std::size_t i = 0; i < 4; ++i) {
        basis.logCenters[i] = meansOf(logCenters[i], groupOf, groups);
    }
    for (std::size_t c = 0; c < 2; ++c) {
        basis.chromaCenters[c] = meansOf(chromaCenters[c], groupOf, groups);
    }
    return basis;
}

}  // namespace abrdf
