// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/pair_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace abrdf {

namespace {

Eigen::Index indexOf(std::size_t i) {
    return static_cast<Eigen::Index>(i);
}

/// Hundredths of a degree: as finely as file names tell directions apart.
long hundredths(Radians angle) {
    return std::lround(degreesFromRadians(angle) * 100);
}

/// Pairs with equal keys are one.
template <typename Key>
PairGroups grouped(std::span<const LightAndView> pairs, const Key& key) {
    std::map<decltype(key(pairs[0])), std::size_t> places;
    PairGroups groups;
    for (const LightAndView& pair : pairs) {
        const auto [place, isNew] = places.try_emplace(key(pair), groups.distinct.size());
        if (isNew) groups.distinct.push_back(pair);
        groups.rowOf.push_back(place->second);
    }
    return groups;
}

}  // namespace

Eigen::MatrixXd isotropicFeatures(std::span<const LightAndView> pairs) {
    Eigen::MatrixXd features(indexOf(pairs.size()), 4);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [light, view] = pairs[i];
        const Imath::V3d half =
            (vectorFromDirection(light) + vectorFromDirection(view)).normalized();
        const double halfAngle = degreesFromRadians(std::acos(std::clamp(half.z, -1.0, 1.0)));
        const double difference = degreesFromRadians(angleBetween(light, view)) / 2;
        features.row(indexOf(i)) << std::log(halfAngle + 2), difference / 40, light.theta,
            view.theta;
    }
    return features;
}

Eigen::MatrixXd vectorFeatures(std::span<const LightAndView> pairs) {
    Eigen::MatrixXd features(indexOf(pairs.size()), 6);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const Imath::V3d light = vectorFromDirection(pairs[i].light);
        const Imath::V3d view = vectorFromDirection(pairs[i].view);
        features.row(indexOf(i)) << light.x, light.y, light.z, view.x, view.y, view.z;
    }
    return features;
}

Eigen::MatrixXd squaredDistances(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    Eigen::MatrixXd distances = -2 * a * b.transpose();
    distances.colwise() += a.rowwise().squaredNorm();
    distances.rowwise() += b.rowwise().squaredNorm().transpose();
    return distances.cwiseMax(0);
}

PairGroups distinctPairs(std::span<const LightAndView> pairs) {
    const auto azimuth = [](Direction d) {
        return hundredths(d.theta) == 0 ? 0 : hundredths(wrappedAzimuth(d.phi)) % 36000;
    };
    return grouped(pairs, [&](const LightAndView& pair) {
        return std::array{hundredths(pair.light.theta), azimuth(pair.light),
                          hundredths(pair.view.theta), azimuth(pair.view)};
    });
}

PairGroups isotropicPairs(std::span<const LightAndView> pairs) {
    return grouped(pairs, [](const LightAndView& pair) {
        const Radians turn = wrappedAzimuth(pair.light.phi - pair.view.phi);
        const bool isPole = hundredths(pair.light.theta) == 0 || hundredths(pair.view.theta) == 0;
        return std::array{hundredths(pair.light.theta), hundredths(pair.view.theta),
                          isPole ? 0 : hundredths(std::min(turn, 2 * kPi - turn))};
    });
}

}  // namespace abrdf
