// SPDX-License-Identifier: BSD-3-Clause
//
// Colours up to and past the border of the working space.
#include "stages/stress/stress_case.h"

#include <algorithm>

namespace abrdf {

namespace {

Rgb scaledChannels(Rgb c, Rgb by) {
    return {c.r * by.r, c.g * by.g, c.b * by.b};
}

}  // namespace

std::vector<StressCase> colorCases() {
    return {
        {"saturation", "red that grows purer: its green and blue fall", "green over red", true,
         false, stepsOf({1, 0.3, 0.1, 0.03, 0.01, 0.001, 0}),
         [](const StressMaterial& material, double rest) {
             const auto r = static_cast<float>(rest);
             StressTrial trial;
             trial.truth = {material.name, [value = material.value, r](const LightAndView& pair) {
                                return scaledChannels(value(pair), {1, r, r});
                            }};
             return trial;
         }},
        {"gamut", "a channel below 0 after conversion, cut there", "green over red", true, false,
         stepsOf({0.1, 0, -0.01, -0.03, -0.1}),
         [](const StressMaterial& material, double green) {
             const auto g = static_cast<float>(green);
             StressTrial trial;
             trial.truth = {material.name, [value = material.value, g](const LightAndView& pair) {
                                const Rgb c = value(pair);
                                return Rgb{c.r, g * c.r, 0.5F * c.b};
                            }};
             // As averages are: moved to the border of the space.
             trial.measured = [value = trial.truth.value](const LightAndView& pair, Random&) {
                 const Rgb c = value(pair);
                 return Rgb{c.r, std::max(c.g, 0.0F), c.b};
             };
             return trial;
         }},
    };
}

}  // namespace abrdf
