// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/pair_features.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace abrdf {

namespace {

Eigen::Index indexOf(std::size_t i) {
    return static_cast<Eigen::Index>(i);
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

IsotropicPairs isotropicPairs(std::span<const LightAndView> pairs) {
    // To a hundredth of a degree, as finely as file names tell directions apart.
    const auto key = [](Radians angle) { return std::lround(degreesFromRadians(angle) * 100); };
    std::map<std::tuple<long, long, long>, std::size_t> places;
    IsotropicPairs result;
    for (const LightAndView& pair : pairs) {
        const Radians turn = wrappedAzimuth(pair.light.phi - pair.view.phi);
        // At the pole an azimuth says nothing.
        const bool isPole = key(pair.light.theta) == 0 || key(pair.view.theta) == 0;
        const long between = isPole ? 0 : key(std::min(turn, 2 * kPi - turn));
        const auto [place, isNew] = places.try_emplace(
            {key(pair.light.theta), key(pair.view.theta), between}, result.distinct.size());
        if (isNew) result.distinct.push_back(pair);
        result.rowOf.push_back(place->second);
    }
    return result;
}

}  // namespace abrdf
