// SPDX-License-Identifier: BSD-3-Clause
//
// Highlights narrower than the samples are dense.
#include "stages/stress/stress_case.h"

#include <cmath>

namespace abrdf {

namespace {

StressTrial glossy(double roughnessX, double roughnessY) {
    StressTrial trial;
    trial.truth = analyticStressMaterial(
        "glossy", {lambertPart({0.3F, 0.2F, 0.1F}),
                   highlightPart(static_cast<float>(roughnessX), static_cast<float>(roughnessY),
                                 0.05F, {1, 1, 1})});
    return trial;
}

}  // namespace

std::vector<StressCase> highlightCases() {
    return {
        {"roughness", "isotropic highlights narrower than the sampling", "GGX roughness", false,
         false, stepsOf({0.5, 0.35, 0.25, 0.18, 0.12, 0.08, 0.05, 0.03, 0.02}),
         [](const StressMaterial&, double alpha) { return glossy(alpha, alpha); }},
        {"anisotropy", "anisotropic highlights of mean roughness 0.2", "ratio of roughnesses",
         false, false, stepsOf({1, 2, 4, 8, 16}),
         [](const StressMaterial&, double ratio) {
             return glossy(0.2 * std::sqrt(ratio), 0.2 / std::sqrt(ratio));
         }},
    };
}

}  // namespace abrdf
