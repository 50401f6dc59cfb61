// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/half_angles.h"

#include <cmath>

namespace abrdf {

HalfAngles halfAnglesFromPair(const LightAndView& pair) {
    const Imath::V3d light = vectorFromDirection(pair.light);
    const Imath::V3d sum = light + vectorFromDirection(pair.view);
    const Direction half = directionFromVector(sum);
    // The light seen from the half vector: turned by -phi_h about z, then by -theta_h about y.
    const double cosPhi = std::cos(half.phi);
    const double sinPhi = std::sin(half.phi);
    const Imath::V3d turned(cosPhi * light.x + sinPhi * light.y,
                            cosPhi * light.y - sinPhi * light.x, light.z);
    const double cosTheta = std::cos(half.theta);
    const double sinTheta = std::sin(half.theta);
    const Direction difference =
        directionFromVector({cosTheta * turned.x - sinTheta * turned.z, turned.y,
                             sinTheta * turned.x + cosTheta * turned.z});
    return {half.theta, difference.theta, difference.phi};
}

LightAndView pairFromHalfAngles(const HalfAngles& angles) {
    const Imath::V3d difference =
        vectorFromDirection({angles.thetaDifference, angles.phiDifference});
    const double cosTheta = std::cos(angles.thetaHalf);
    const double sinTheta = std::sin(angles.thetaHalf);
    const auto turned = [&](double x, double y, double z) {
        return directionFromVector(
            Imath::V3d(cosTheta * x + sinTheta * z, y, cosTheta * z - sinTheta * x));
    };
    return {turned(difference.x, difference.y, difference.z),
            turned(-difference.x, -difference.y, difference.z)};
}

}  // namespace abrdf
