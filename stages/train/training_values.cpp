// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/training_values.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

std::vector<VectorPair> vectorPairs(std::span<const LightAndView> pairs) {
    std::vector<VectorPair> vectors;
    vectors.reserve(pairs.size());
    for (const LightAndView& pair : pairs) {
        vectors.push_back({Imath::V3f(vectorFromDirection(pair.light)),
                           Imath::V3f(vectorFromDirection(pair.view))});
    }
    return vectors;
}

Eigen::MatrixXf valuesOf(std::span<const PreparedMaterial> materials,
                         std::span<const VectorPair> pairs) {
    Eigen::MatrixXf values(static_cast<Eigen::Index>(pairs.size()),
                           static_cast<Eigen::Index>(materials.size()));
    forEachTexelBlock(materials.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            materials[m].evaluate(pairs,
                                  {values.col(static_cast<Eigen::Index>(m)).data(), pairs.size()});
        }
    });
    return values;
}

Eigen::VectorXd valuesOf(const PreparedMaterial& material, std::span<const VectorPair> pairs) {
    Eigen::VectorXf values(static_cast<Eigen::Index>(pairs.size()));
    material.evaluate(pairs, {values.data(), pairs.size()});
    return values.cast<double>();
}

Eigen::VectorXd quantileOfColumns(const Eigen::MatrixXf& values, double q) {
    Eigen::VectorXd result(values.cols());
    forEachTexelBlock(
        static_cast<std::size_t>(values.cols()), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const auto column = values.col(static_cast<Eigen::Index>(c));
                std::vector<float> sorted(column.data(), column.data() + column.size());
                const double rank = q * static_cast<double>(sorted.size() - 1);
                const auto below = sorted.begin() + static_cast<std::ptrdiff_t>(rank);
                std::nth_element(sorted.begin(), below, sorted.end());
                const auto low = static_cast<double>(*below);
                const auto above = below + 1;
                const double high =
                    above == sorted.end()
                        ? low
                        : static_cast<double>(*std::min_element(above, sorted.end()));
                result(static_cast<Eigen::Index>(c)) =
                    low + (rank - std::floor(rank)) * (high - low);
            }
        });
    return result;
}

}  // namespace abrdf
