// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

namespace abrdf {

/// A pair of directions as half vector and difference [Rusinkiewicz 1998]: theta_h, theta_d in
/// 0 .. pi/2, phi_d in 0 .. 2 pi. phi_h is left out: isotropic materials do not know it.
struct HalfAngles {
    Radians thetaHalf = 0;
    Radians thetaDifference = 0;
    Radians phiDifference = 0;
};

HalfAngles halfAnglesFromPair(const LightAndView& pair);

/// The inverse, with the half vector at azimuth 0. A direction may lie below the horizon.
LightAndView pairFromHalfAngles(const HalfAngles& angles);

}  // namespace abrdf
