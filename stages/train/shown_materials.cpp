// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/shown_materials.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/portable_math.h"
#include "stages/train/training_values.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace abrdf {

namespace {

constexpr float kFloor = 1e-2F;  ///< Below this share of the body nothing is to be learned.

/// Of the highlight exposure, where the natural one counts 1.
constexpr double kHighlightShare = 0.5;

/// dL* / d ln B; nothing changes on a display where B is above 1.
double sensitivity(double value) {
    if (value >= 1) return 0;
    return value > 0.008856 ? 116.0 / 3 * std::cbrt(value) : 903.3 * value;
}

Eigen::VectorXd weights(const Eigen::MatrixXf& values, const Eigen::VectorXd& highlight,
                        const WatchedPairs& watched) {
    Eigen::VectorXd weight(watched.share.size());
    for (Eigen::Index w = 0; w < weight.size(); ++w) {
        double sum = 0;
        for (Eigen::Index m = 0; m < values.cols(); ++m) {
            const auto value =
                static_cast<double>(values(watched.pairs[static_cast<std::size_t>(w)], m));
            const double natural = sensitivity(value);
            const double highlit = sensitivity(value / std::max(highlight(m), 1e-12));
            sum += natural * natural + kHighlightShare * highlit * highlit;
        }
        weight(w) = std::sqrt(sum / static_cast<double>(values.cols()) * watched.share(w));
    }
    return weight;
}

/// 0 where there are no pairs.
float medianAt(const std::vector<Eigen::Index>& pairs, const Eigen::MatrixXf& values,
               Eigen::Index material) {
    std::vector<float> sorted;
    for (const Eigen::Index pair : pairs) sorted.push_back(values(pair, material));
    if (sorted.empty()) return 0;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    return *middle;
}

Eigen::MatrixXf logarithms(const Eigen::MatrixXf& values, const Eigen::VectorXd& highlight,
                           const AngularGrid& grid) {
    std::vector<Eigen::Index> body;
    for (std::size_t i = 0; i < grid.pairCount(); ++i) {
        if (halfAngle(grid.pair(i)) > radiansFromDegrees(25)) {
            body.push_back(static_cast<Eigen::Index>(i));
        }
    }
    Eigen::MatrixXf logs(values.cols(), values.rows());
    forEachTexelBlock(
        static_cast<std::size_t>(values.cols()), 8, [&](std::size_t begin, std::size_t end) {
            for (std::size_t m = begin; m < end; ++m) {
                const auto material = static_cast<Eigen::Index>(m);
                const auto least = static_cast<float>(std::max(1e-6 * highlight(material), 1e-12));
                const float unit = 1 / std::max(medianAt(body, values, material), least);
                for (Eigen::Index i = 0; i < values.rows(); ++i) {
                    logs(material, i) = portable::log(values(i, material) * unit + kFloor);
                }
            }
        });
    logs.rowwise() -= logs.colwise().mean().eval();
    return logs;
}

}  // namespace

ShownMaterials shownMaterials(std::span<const AnalyticMaterial> materials,
                              const std::vector<LightAndView>& pairs, const AngularGrid& grid,
                              const WatchedPairs& watched) {
    const std::vector<PreparedMaterial> prepared(materials.begin(), materials.end());
    const Eigen::MatrixXf values = valuesOf(prepared, vectorPairs(pairs));
    const auto gridPairs = static_cast<Eigen::Index>(grid.pairCount());
    const Eigen::VectorXd highlight = quantileOfColumns(values.topRows(gridPairs), 0.995);
    return {logarithms(values, highlight, grid), weights(values, highlight, watched)};
}

}  // namespace abrdf
