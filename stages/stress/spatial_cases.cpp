// SPDX-License-Identifier: BSD-3-Clause
//
// What a texel holds besides its own material: the neighbours, by averaging, by images that do not
// lie on one another, by parallax.
#include "stages/stress/stress_case.h"

#include <cmath>

namespace abrdf {

namespace {

/// Albedo along x of a texture whose threads are four texels wide, 0.2 .. 1.
float texture(double x, double y) {
    const double threads = std::sin(2 * kPi * x / 8) + 0.5 * std::sin(2 * kPi * (x + 2 * y) / 13);
    return static_cast<float>(0.6 + 0.4 * threads / 1.5);
}

/// A sample's texel is seen `shift` texels off.
StressTrial displaced(
    const StressMaterial& material,
    std::function<std::pair<double, double>(const LightAndView&, Random&)> shift) {
    StressTrial trial;
    trial.truth = {material.name, [value = material.value](const LightAndView& pair) {
                       return texture(0, 0) * value(pair);
                   }};
    trial.measured = [value = material.value, shift = std::move(shift)](const LightAndView& pair,
                                                                        Random& random) {
        const auto [x, y] = shift(pair, random);
        return texture(x, y) * value(pair);
    };
    return trial;
}

}  // namespace

std::vector<StressCase> spatialCases() {
    return {
        {"mixed", "an average with another material, black metal", "its share", true, false,
         stepsOf({0, 0.1, 0.25, 0.5, 0.75}, 100, " %"),
         [](const StressMaterial& material, double share) {
             const auto s = static_cast<float>(share);
             const StressMaterial other =
                 analyticStressMaterial("metal", {highlightPart(0.12F, 0.3F, 0.6F, {1, 1, 1})});
             StressTrial trial;
             trial.truth = {material.name,
                            [a = material.value, b = other.value, s](const LightAndView& pair) {
                                return (1 - s) * a(pair) + s * b(pair);
                            }};
             return trial;
         }},
        {"misregistered", "images off by some texels at random", "deviation in texels", true, false,
         stepsOf({0, 0.25, 0.5, 1, 2, 4}),
         [](const StressMaterial& material, double texels) {
             return displaced(material, [texels](const LightAndView&, Random& random) {
                 const double x = texels * random.normal();
                 return std::pair(x, texels * random.normal());
             });
         }},
        {"parallax", "a surface above the plane of rectification", "height in texels", true, false,
         stepsOf({0, 0.25, 0.5, 1, 2, 4}),
         [](const StressMaterial& material, double height) {
             return displaced(material, [height](const LightAndView& pair, Random&) {
                 const double along = height * std::tan(pair.view.theta);
                 return std::pair(along * std::cos(pair.view.phi), along * std::sin(pair.view.phi));
             });
         }},
    };
}

}  // namespace abrdf
