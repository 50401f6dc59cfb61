// SPDX-License-Identifier: BSD-3-Clause
//
// Plans of samples on which a method stands badly: slices at special offsets, elevations that
// coincide, too few samples and too many.
#include "stages/stress/stress_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace abrdf {

namespace {

StressTrial planned(const StressMaterial& material, SamplePlan plan) {
    StressTrial trial;
    trial.truth = material;
    trial.plan = std::move(plan);
    return trial;
}

/// The poster's plan with other numbers; its own check is left to the methods.
SamplePlan poster(const SlicePlan& slices) {
    SamplePlan plan;
    plan.name = slices.name;
    plan.samples = slices.samples();
    plan.posterSlices = slices;
    return plan;
}

/// The first `count` of the built-in pairs.
SamplePlan greedy(std::size_t count) {
    const std::vector<std::size_t>& pairs = greedyPairsOfUbo81();
    return pairsPlan(fmt::format("greedy:{}", count), AngularGrid(ubo81Directions()),
                     {pairs.begin(),
                      pairs.begin() + static_cast<std::ptrdiff_t>(std::min(count, pairs.size()))});
}

StressTrial ofDensity(const StressMaterial& material, double factor) {
    SlicePlan slices;
    slices.axialCount = std::max(1, static_cast<int>(slices.axialCount * factor));
    slices.diagonalCount = std::max(1, static_cast<int>(slices.diagonalCount * factor));
    return planned(material, poster(slices));
}

}  // namespace

std::vector<StressCase> planCases() {
    return {
        {"alpha", "offset of the poster's slices", "alpha", true, true,
         stepsOf({90, 45, 0, 180}, 1, " deg"),
         [](const StressMaterial& material, double degrees) {
             SlicePlan slices;
             slices.alpha = radiansFromDegrees(degrees);
             return planned(material, poster(slices));
         }},
        {"elevations", "the poster's elevations draw together, below 75 degrees", "difference",
         true, false, stepsOf({45, 30, 15, 5, 1, 0.01, 0}, 1, " deg"),
         [](const StressMaterial& material, double difference) {
             SlicePlan slices;
             slices.elevations = {radiansFromDegrees(75 - difference), radiansFromDegrees(75)};
             return planned(material, poster(slices));
         }},
        {"few", "fewer and fewer free samples", "samples", true, false,
         stepsOf({204, 100, 52, 28, 16, 8, 4, 2, 1}),
         [](const StressMaterial& material, double count) {
             return planned(material, greedy(static_cast<std::size_t>(count)));
         }},
        {"one-subspace", "the poster's first subspaces alone", "subspaces", true, false,
         stepsOf({4, 3, 2, 1}),
         [](const StressMaterial& material, double count) {
             SlicePlan slices;
             SamplePlan plan = poster(slices);
             plan.samples.resize(static_cast<std::size_t>(count) * slices.samplesPerSubspace());
             if (count < 4) plan.posterSlices.reset();
             return planned(material, plan);
         }},
        {"dense", "the poster's slices, sparser and ten times too dense", "times as many", true,
         true, stepsOf({1, 0.25, 0.05, 3, 10}), ofDensity},
    };
}

}  // namespace abrdf
