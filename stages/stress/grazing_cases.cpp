// SPDX-License-Identifier: BSD-3-Clause
//
// Elevations past the last that was measured, 75 degrees.
#include "stages/stress/stress_case.h"

namespace abrdf {

namespace {

/// UBO2003's rings at 15 and 75 degrees and one at theta: few directions, so that the prior is
/// soon trained for them.
AngularGrid gridWithRing(Radians theta) {
    std::vector<Direction> directions;
    for (const double degrees : {15.0, 75.0}) {
        for (int k = 0; k < 6; ++k) {
            directions.push_back({radiansFromDegrees(degrees), k * kPi / 3});
        }
    }
    if (theta > radiansFromDegrees(75.5)) {
        for (int k = 0; k < 12; ++k) directions.push_back({theta, k * kPi / 6});
    }
    return AngularGrid(directions);
}

}  // namespace

std::vector<StressCase> grazingCases() {
    return {{"grazing", "elevations asked for, measured up to 75 degrees", "elevation", true, false,
             stepsOf({75, 78, 81, 84, 87, 89}, 1, " deg"),
             [](const StressMaterial& material, double degrees) {
                 StressTrial trial;
                 trial.truth = material;
                 trial.grid = gridWithRing(radiansFromDegrees(degrees));
                 trial.leastTheta = radiansFromDegrees(degrees - 0.1);
                 return trial;
             }}};
}

}  // namespace abrdf
