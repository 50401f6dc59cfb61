// SPDX-License-Identifier: BSD-3-Clause
//
// Dynamic range: highlights far above the body, and what over-exposed images leave of them.
#include "stages/stress/stress_case.h"

#include <algorithm>

namespace abrdf {

namespace {

StressMaterial bright(double factor) {
    const auto f = static_cast<float>(factor);
    return analyticStressMaterial("bright", {lambertPart({0.15F, 0.1F, 0.05F}),
                                             highlightPart(0.06F, 0.06F, 0.05F, {f, f, f})});
}

}  // namespace

std::vector<StressCase> rangeCases() {
    return {
        {"range", "highlights times a factor", "factor", false, false,
         stepsOf({1, 10, 100, 1000, 10000}),
         [](const StressMaterial&, double factor) {
             StressTrial trial;
             trial.truth = bright(factor);
             return trial;
         }},
        {"clipped", "over-exposed samples, clipped at 1", "exposure", true, false,
         stepsOf({0.5, 1, 2, 4, 8, 16}),
         [](const StressMaterial& material, double exposure) {
             const auto e = static_cast<float>(exposure);
             StressTrial trial;
             trial.truth = material;
             trial.measured = [value = material.value, e](const LightAndView& pair, Random&) {
                 const Rgb c = e * value(pair);
                 return 1 / e * Rgb{std::min(c.r, 1.0F), std::min(c.g, 1.0F), std::min(c.b, 1.0F)};
             };
             trial.saturated = 0.99 / exposure;
             return trial;
         }},
    };
}

}  // namespace abrdf
