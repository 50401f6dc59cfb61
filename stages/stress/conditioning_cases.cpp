// SPDX-License-Identifier: BSD-3-Clause
//
// Linear systems that become singular: samples that double one another, elevations that meet, and
// more and more samples. A twin in longer floats shows what of an answer is rounding.
#include "stages/stress/stress_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

/// Grey, so that a twin needs no chroma: a body and a highlight.
StressMaterial greyPlastic() {
    return analyticStressMaterial("grey plastic", {lambertPart({0.3F, 0.3F, 0.3F}),
                                                   highlightPart(0.25F, 0.25F, 0.05F, {1, 1, 1})});
}

std::vector<LightAndView> greedySamples(std::size_t count) {
    const AngularGrid grid(ubo81Directions());
    const std::vector<std::size_t>& pairs = greedyPairsOfUbo81();
    std::vector<LightAndView> samples;
    for (std::size_t k = 0; k < std::min(count, pairs.size()); ++k) {
        samples.push_back(grid.pair(pairs[k]));
    }
    return samples;
}

StressTrial withTwin(SamplePlan plan) {
    StressTrial trial;
    trial.truth = greyPlastic();
    trial.plan = std::move(plan);
    trial.exactPlaces = true;
    return trial;
}

/// A hundred samples and each again, turned and lowered by a distance; the slices' elevations as
/// far apart.
StressTrial doubled(double degrees) {
    const Radians apart = radiansFromDegrees(degrees);
    SamplePlan plan;
    plan.name = fmt::format("doubled:{:g}", degrees);
    plan.samples = greedySamples(100);
    for (std::size_t k = 0; k < 100; ++k) {
        LightAndView twin = plan.samples[k];
        // Away from the horizon and past no pole.
        twin.light.theta = std::abs(twin.light.theta - apart);
        twin.view.phi = wrappedAzimuth(twin.view.phi + apart);
        plan.samples.push_back(twin);
    }
    SlicePlan slices;
    slices.elevations = {radiansFromDegrees(75 - degrees), radiansFromDegrees(75)};
    plan.posterSlices = slices;
    return withTwin(std::move(plan));
}

}  // namespace

std::vector<StressCase> conditioningCases() {
    StressCase doubling{"conditioning",
                        "samples doubled, and the slices' elevations as near to each other",
                        "distance of the doubles",
                        false,
                        false,
                        stepsOf({30, 10, 3, 1, 0.3, 0.1, 0.01, 0.001, 0}, 1, " deg"),
                        [](const StressMaterial&, double degrees) { return doubled(degrees); }};
    doubling.hasTwin = true;
    StressCase many{"conditioning-many",
                    "more and more free samples",
                    "samples",
                    false,
                    false,
                    stepsOf({204, 100, 52, 16, 4, 300, 400}),
                    [](const StressMaterial&, double count) {
                        SamplePlan plan;
                        plan.name = fmt::format("greedy:{:g}", count);
                        plan.samples = greedySamples(static_cast<std::size_t>(count));
                        return withTwin(std::move(plan));
                    }};
    many.kindsOnly = true;
    many.hasTwin = true;
    return {doubling, many};
}

}  // namespace abrdf
