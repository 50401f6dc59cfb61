// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/preview/light.h"

namespace abrdf {

/// A photographer's studio: a large key light upper left, a fill right, strips behind, a bright
/// ceiling and a dark floor, all neutral.
EnvironmentMap studioEnvironment();

/// Clear sky of turbidity 3 over grey ground, linear Rec.709, without its sun
/// [Preetham, Shirley, Smits 1999].
EnvironmentMap skyEnvironment(const Imath::V3d& sun);

/// Where the built-in sky has its sun, and the sun itself, in the sky's units.
Imath::V3d skySunDirection();
Light skySun(const EnvironmentMap& sky);

}  // namespace abrdf
