// SPDX-License-Identifier: BSD-3-Clause
//
// Directions that are not what their names say.
#include "stages/stress/stress_case.h"

#include <algorithm>

namespace abrdf {

namespace {

Direction moved(Direction d, Radians theta, Radians phi) {
    return {std::clamp(d.theta + theta, 0.0, radiansFromDegrees(89.5)),
            wrappedAzimuth(d.phi + phi)};
}

/// Each direction of each sample is off by a normal deviation.
StressTrial wrong(const StressMaterial& material, Radians theta, Radians phi) {
    StressTrial trial;
    trial.truth = material;
    trial.measured = [value = material.value, theta, phi](const LightAndView& pair,
                                                          Random& random) {
        const auto off = [&](Direction d) {
            const double byTheta = theta * random.normal();
            return moved(d, byTheta, phi * random.normal());
        };
        const Direction light = off(pair.light);
        return value({light, off(pair.view)});
    };
    return trial;
}

}  // namespace

std::vector<StressCase> angleCases() {
    return {
        {"elevation", "elevations off at random", "deviation", true, false,
         stepsOf({0, 0.5, 1, 2, 3, 5}, 1, " deg"),
         [](const StressMaterial& material, double degrees) {
             return wrong(material, radiansFromDegrees(degrees), 0);
         }},
        {"azimuth", "azimuths off at random", "deviation", true, false,
         stepsOf({0, 0.5, 1, 2, 3, 5}, 1, " deg"),
         [](const StressMaterial& material, double degrees) {
             return wrong(material, 0, radiansFromDegrees(degrees));
         }},
        {"turned", "a material that lies turned on the stage", "azimuth", true, false,
         stepsOf({0, 5, 10, 20, 45, 90}, 1, " deg"),
         [](const StressMaterial& material, double degrees) {
             StressTrial trial;
             trial.truth = turned(material, radiansFromDegrees(degrees));
             return trial;
         }},
        {"exchanged", "light and view exchanged in a share of the samples", "share", true, false,
         stepsOf({0, 0.05, 0.1, 0.25, 0.5, 1}, 100, " %"),
         [](const StressMaterial& material, double share) {
             StressTrial trial;
             trial.truth = material;
             trial.measured = [value = material.value, share](const LightAndView& pair,
                                                              Random& random) {
                 return random.chance(share) ? value({pair.view, pair.light}) : value(pair);
             };
             return trial;
         }},
    };
}

}  // namespace abrdf
