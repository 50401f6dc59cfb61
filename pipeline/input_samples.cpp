// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/input_samples.h"

#include "pipeline/named_pair.h"
#include "stages/slice/choose_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace abrdf {

namespace {

/// Throws where images that the job needs are absent.
[[noreturn]] void failMissing(const std::vector<std::size_t>& missing, const OpenedInput& input) {
    std::string names;
    for (std::size_t i = 0; i < std::min<std::size_t>(5, missing.size()); ++i) {
        names += fmt::format("{}{}", i > 0 ? ", " : "",
                             pairName(input.description().grid.pair(missing[i])));
    }
    throw std::runtime_error(fmt::format(
        "{}: {} of the images that this job needs {} missing ({}{}); --missing fill would "
        "interpolate them from their neighbours and count them",
        input.description().source, missing.size(), missing.size() == 1 ? "is" : "are", names,
        missing.size() > 5 ? " ..." : ""));
}

/// The slices can be interpolated between measured elevations only.
void checkElevations(const SlicePlan& plan, const OpenedInput& input) {
    const auto check = [&](const std::vector<Direction>& directions, const char* what) {
        Radians least = directions.front().theta;
        Radians greatest = least;
        for (const Direction& d : directions) {
            least = std::min(least, d.theta);
            greatest = std::max(greatest, d.theta);
        }
        for (const Radians theta : plan.elevations) {
            constexpr Radians kRounding = radiansFromDegrees(0.1);
            if (theta >= least - kRounding && theta <= greatest + kRounding) continue;
            throw std::runtime_error(fmt::format(
                "{}: the plan's elevation of {:g} degrees lies outside the measured {} directions, "
                "whose theta goes from {:g} to {:g} degrees; choose others with --elevations, or "
                "--method measured",
                input.description().source, degreesFromRadians(theta), what,
                degreesFromRadians(least), degreesFromRadians(greatest)));
        }
    };
    check(input.description().grid.lights(), "light");
    check(input.description().grid.views(), "view");
}

}  // namespace

const AngularGrid& sampledGrid(const Method& method, const OpenedInput& input,
                               const AngularGrid& output) {
    const bool anywhere = input.reader->table() != nullptr;
    return anywhere && method.wish == SampleWish::kEverything ? output : input.description().grid;
}

SampleSet samplesFor(const Method& method, const SamplePlan& plan, const OpenedInput& input,
                     const AngularGrid& output) {
    if (input.reader->table() != nullptr) {
        switch (method.wish) {
            case SampleWish::kEverything:
                return exactSamples(pairsOf(output));
            case SampleWish::kSlices:
                return exactSamples(plan.posterSlices->samples());
            case SampleWish::kMeasuredPairs:
                return exactSamples(plan.samples);
        }
    }
    const BtfDescription& description = input.description();
    if (method.wish == SampleWish::kSlices) checkElevations(*plan.posterSlices, input);
    // Another grid than the database's may not need all of it.
    SampleSet samples =
        method.wish == SampleWish::kEverything && output != description.grid
            ? samplesOfPairs(description.grid, PairInterpolation(description.grid).pairsFor(output))
            : chooseSamples(plan, description.grid, method.wish);
    const std::vector<std::size_t> missing = missingPairs(samples, description.present);
    if (missing.empty()) return samples;
    if (input.missing == MissingImages::kError) failMissing(missing, input);
    // Methods that take any set of pairs do without the missing ones.
    return method.wish == SampleWish::kMeasuredPairs
               ? dropMissing(std::move(samples), description.present)
               : fillMissing(std::move(samples), description.grid, description.present);
}

}  // namespace abrdf
