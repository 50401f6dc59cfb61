// SPDX-License-Identifier: BSD-3-Clause
//
// Materials that are none, or that no model has in mind.
#include "stages/stress/stress_case.h"

#include <array>
#include <cmath>

namespace abrdf {

namespace {

StressMaterial silver() {
    return analyticStressMaterial("mirror", {highlightPart(0.01F, 0.01F, 0.9F, {1, 1, 1})});
}

StressMaterial retroReflector() {
    ColoredPart part = lambertPart({0.3F, 0.3F, 0.3F});
    part.material.facets[0].retro.strength = 2;
    part.material.facets[0].retro.width = 0.02F;
    return analyticStressMaterial("retro-reflector", {part});
}

StressMaterial groove() {
    ColoredPart part;
    part.color = {0.8F, 0.5F, 0.3F};
    for (const double side : {0.0, kPi}) {
        Facet facet;
        facet.tilt = radiansFromDegrees(40);
        facet.azimuth = side;
        facet.groove = 1;
        facet.diffuse.albedo = side > 0 ? 0.9F : 0.15F;
        part.material.facets.push_back(facet);
    }
    return analyticStressMaterial("groove", {part});
}

Rgb grey(double value) {
    const auto v = static_cast<float>(value);
    return {v, v, v};
}

std::vector<StressMaterial> degenerateMaterials() {
    return {
        analyticStressMaterial("plastic", {lambertPart({0.3F, 0.2F, 0.1F}),
                                           highlightPart(0.3F, 0.3F, 0.04F, {1, 1, 1})}),
        {"black", [](const LightAndView&) { return Rgb{}; }},
        analyticStressMaterial("white", {lambertPart({1, 1, 1})}),
        analyticStressMaterial(
            "no blue", {lambertPart({0.6F, 0.3F, 0}), highlightPart(0.3F, 0.3F, 0.04F, {1, 1, 0})}),
        {"one bright pair",
         [](const LightAndView& p) {
             const bool isThere = angleBetween(p.light, {radiansFromDegrees(30), 0}) < 0.02 &&
                                  angleBetween(p.view, {radiansFromDegrees(30), kPi}) < 0.02;
             return grey(isThere ? 50 : 0.2 * std::cos(p.light.theta));
         }},
        retroReflector(),
        silver(),
        groove(),
        {"step in azimuth",
         [](const LightAndView& p) {
             const double step = std::sin(2 * p.light.phi + 0.3) > 0 ? 0.8 : 0.1;
             return grey(step * std::cos(p.light.theta));
         }},
        {"noise",
         [](const LightAndView& p) {
             // No two pairs have anything to do with one another.
             const auto code = [](double angle) {
                 return static_cast<std::uint64_t>(std::llround(1e6 * angle));
             };
             return grey(uniformFromHash(hashOf(
                 {code(p.light.theta), code(p.light.phi), code(p.view.theta), code(p.view.phi)})));
         }},
    };
}

}  // namespace

std::vector<StressCase> degenerateCases() {
    const std::vector<StressMaterial> materials = degenerateMaterials();
    StressCase all{
        "degenerate", "materials that no model has in mind", "material", false, true, {}, {}};
    for (std::size_t i = 0; i < materials.size(); ++i) {
        all.steps.push_back({static_cast<double>(i), materials[i].name});
    }
    all.trial = [materials](const StressMaterial&, double index) {
        StressTrial trial;
        trial.truth = materials[static_cast<std::size_t>(index)];
        return trial;
    };
    return {all};
}

}  // namespace abrdf
