// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/merl_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

/// Two neighbouring cells and the share of the second.
struct Between {
    std::size_t before = 0;
    std::size_t after = 0;
    double share = 0;
};

/// place: in cells from the first one's edge. Past the outermost middles their value is held.
Between clampedBetween(double place, std::size_t cells) {
    const double fromMiddle = std::clamp(place - 0.5, 0.0, static_cast<double>(cells - 1));
    const auto before = std::min(static_cast<std::size_t>(fromMiddle), cells - 1);
    return {before, std::min(before + 1, cells - 1), fromMiddle - static_cast<double>(before)};
}

/// phi_d and phi_d + pi are one value, so the cells close on themselves.
Between periodicBetween(double place, std::size_t cells) {
    const double count = static_cast<double>(cells);
    double fromMiddle = place - 0.5;
    fromMiddle -= count * std::floor(fromMiddle / count);
    const auto before = static_cast<std::size_t>(fromMiddle) % cells;
    return {before, (before + 1) % cells, fromMiddle - std::floor(fromMiddle)};
}

}  // namespace

namespace merl {

HalfAngles anglesOfEntry(std::size_t entry) {
    const auto middle = [](std::size_t cell) { return static_cast<double>(cell) + 0.5; };
    const double root = middle(entry / (kThetaDifference * kPhiDifference)) / kThetaHalf;
    return {kPi / 2 * root * root,
            kPi / 2 * middle(entry / kPhiDifference % kThetaDifference) / kThetaDifference,
            kPi * middle(entry % kPhiDifference) / kPhiDifference};
}

}  // namespace merl

Rgb MerlTable::evaluate(const LightAndView& pair) const {
    using namespace merl;
    const HalfAngles angles = halfAnglesFromPair(pair);
    const double root = std::sqrt(angles.thetaHalf / (kPi / 2));
    const Between half = clampedBetween(root * kThetaHalf, kThetaHalf);
    const Between difference =
        clampedBetween(angles.thetaDifference / (kPi / 2) * kThetaDifference, kThetaDifference);
    const Between phi =
        periodicBetween(angles.phiDifference / kPi * kPhiDifference, kPhiDifference);
    constexpr double kRounding = 1e-9;  // At an entry's middle the others have no say.
    double weights = 0;
    std::array<double, 3> sum{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const auto choose = [&](const Between& b, std::size_t bit, double& weight) {
            const bool second = (corner >> bit & 1) != 0;
            weight *= second ? b.share : 1 - b.share;
            return second ? b.after : b.before;
        };
        double weight = 1;
        const std::size_t h = choose(half, 0, weight);
        const std::size_t d = choose(difference, 1, weight);
        const std::size_t p = choose(phi, 2, weight);
        const Rgb value = brdf_[entry(h, d, p)];
        if (weight < kRounding || !isFinite(value)) continue;
        weights += weight;
        sum[0] += weight * static_cast<double>(value.r);
        sum[1] += weight * static_cast<double>(value.g);
        sum[2] += weight * static_cast<double>(value.b);
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    if (weights <= 0) return {kNaN, kNaN, kNaN};
    // Reflectance factor times cosine: pi f cos(theta_i).
    const double factor = kPi * std::cos(pair.light.theta) / weights;
    return {static_cast<float>(factor * sum[0]), static_cast<float>(factor * sum[1]),
            static_cast<float>(factor * sum[2])};
}

}  // namespace abrdf
