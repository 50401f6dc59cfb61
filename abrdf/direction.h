// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ImathVec.h>

#include <numbers>

namespace abrdf {

using Radians = double;

constexpr Radians kPi = std::numbers::pi;

constexpr Radians radiansFromDegrees(double degrees) {
    return degrees * (kPi / 180);
}
constexpr double degreesFromRadians(Radians angle) {
    return angle * (180 / kPi);
}

/// Points away from the surface. theta: angle from the normal, 0 .. pi/2; phi: azimuth from +x
/// (image right) towards +y (image up), 0 .. 2 pi.
struct Direction {
    Radians theta = 0;
    Radians phi = 0;

    constexpr bool operator==(const Direction&) const = default;
};

/// The two directions of one photograph: (theta_i, phi_i) and (theta_v, phi_v).
struct LightAndView {
    Direction light;
    Direction view;

    constexpr bool operator==(const LightAndView&) const = default;
};

/// Unit vector, z along the normal.
Imath::V3d vectorFromDirection(Direction direction);

/// The inverse of vectorFromDirection(); phi is 0 at the pole.
Direction directionFromVector(const Imath::V3d& vector);

/// `angle` turned into 0 .. 2 pi (2 pi excluded); 0 where it is not finite.
Radians wrappedAzimuth(Radians angle);

/// Squared distance of two pairs as points of the product of two unit spheres.
double squaredDistance(const LightAndView& a, const LightAndView& b);

/// Angle between two directions.
Radians angleBetween(Direction a, Direction b);

}  // namespace abrdf
