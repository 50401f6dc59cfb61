// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/watched_pairs.h"

#include "abrdf/random.h"
#include "abrdf/scene_pairs.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace abrdf {

namespace {

constexpr std::size_t kOutputs = 1500;  ///< Pairs whose uncertainty is watched, beside mirrors.

bool isMirror(const LightAndView& pair) {
    return halfAngle(pair) < radiansFromDegrees(1e-3);
}

}  // namespace

Radians halfAngle(const LightAndView& pair) {
    const Imath::V3d half =
        (vectorFromDirection(pair.light) + vectorFromDirection(pair.view)).normalized();
    return std::acos(std::clamp(half.z, -1.0, 1.0));
}

WatchedPairs watchedPairs(const AngularGrid& grid, std::uint64_t seed) {
    std::vector<Eigen::Index> mirrors;
    std::vector<Eigen::Index> others;
    for (std::size_t i = 0; i < grid.pairCount(); ++i) {
        (isMirror(grid.pair(i)) ? mirrors : others).push_back(static_cast<Eigen::Index>(i));
    }
    Random random(seed, hashOf({grid.pairCount()}));
    const std::size_t kept = std::min(kOutputs, others.size());
    for (std::size_t i = 0; i < kept; ++i) {
        std::swap(others[i], others[i + random.below(others.size() - i)]);
    }
    WatchedPairs watched;
    watched.pairs = mirrors;
    watched.pairs.insert(watched.pairs.end(), others.begin(),
                         others.begin() + static_cast<std::ptrdiff_t>(kept));
    watched.share = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(watched.pairs.size()));
    watched.share.tail(static_cast<Eigen::Index>(kept))
        .setConstant(static_cast<double>(others.size()) /
                     static_cast<double>(std::max<std::size_t>(kept, 1)));
    return watched;
}

WatchedPairs watchedPairs(const AngularGrid& grid, const std::vector<LightAndView>& scene,
                          std::span<const double> weights) {
    WatchedPairs watched;
    std::vector<double> shares;
    const auto watch = [&](std::size_t pair, double share) {
        watched.pairs.push_back(
            static_cast<Eigen::Index>(grid.pairCount() + watched.others.size()));
        watched.others.push_back(scene[pair]);
        shares.push_back(share);
    };
    if (scene.size() <= kOutputs) {
        for (std::size_t i = 0; i < scene.size(); ++i) watch(i, weights[i]);
    } else {
        for (const std::size_t i : spreadByWeight(weights, kOutputs)) watch(i, 1.0 / kOutputs);
    }
    watched.share =
        Eigen::Map<Eigen::VectorXd>(shares.data(), static_cast<Eigen::Index>(shares.size()));
    return watched;
}

}  // namespace abrdf
