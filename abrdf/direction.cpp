// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/direction.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

Imath::V3d vectorFromDirection(Direction direction) {
    const double sinTheta = std::sin(direction.theta);
    return {sinTheta * std::cos(direction.phi), sinTheta * std::sin(direction.phi),
            std::cos(direction.theta)};
}

Direction directionFromVector(const Imath::V3d& vector) {
    const double sinTheta = std::hypot(vector.x, vector.y);
    const Radians phi = sinTheta > 0 ? wrappedAzimuth(std::atan2(vector.y, vector.x)) : 0;
    return {std::atan2(sinTheta, vector.z), phi};
}

Radians wrappedAzimuth(Radians angle) {
    // Look-ups ask for little else.
    if (angle > 0 && angle < 2 * kPi) return angle;
    // Of so many turns the product below would leave anything but an azimuth.
    constexpr Radians kManyTurns = 1e9;
    if (std::abs(angle) > kManyTurns) angle = std::fmod(angle, 2 * kPi);
    const Radians wrapped = angle - 2 * kPi * std::floor(angle / (2 * kPi));
    return wrapped < 2 * kPi ? wrapped : 0;
}

Radians angleBetween(Direction a, Direction b) {
    // The chord, not the arc cosine of a dot product: exact for equal and near directions.
    const double chord = (vectorFromDirection(a) - vectorFromDirection(b)).length();
    return 2 * std::asin(std::min(1.0, chord / 2));
}

double squaredDistance(const LightAndView& a, const LightAndView& b) {
    return (vectorFromDirection(a.light) - vectorFromDirection(b.light)).length2() +
           (vectorFromDirection(a.view) - vectorFromDirection(b.view)).length2();
}

}  // namespace abrdf
