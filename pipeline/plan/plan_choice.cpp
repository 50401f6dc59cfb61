// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan_choice.h"

#include "pipeline/plan/expected_error.h"
#include "pipeline/plan/greedy_cache.h"
#include "pipeline/plan/plan_file.h"
#include "stages/slice/snap_plan.h"
#include "stages/train/greedy_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

bool hasPosterNumbers(const PlanChoice& choice) {
    return !choice.elevations.empty() || choice.alpha || choice.axial != 0 || choice.diagonal != 0;
}

SlicePlan posterSlices(const PlanChoice& choice, std::size_t bound) {
    SlicePlan slices =
        slicePlanFromName(bound > 0 ? fmt::format("poster:{}", bound) : std::string("poster"));
    if (!choice.elevations.empty()) {
        slices.elevations.clear();
        for (const double degrees : choice.elevations) {
            slices.elevations.push_back(radiansFromDegrees(degrees));
        }
    }
    if (choice.alpha) slices.alpha = radiansFromDegrees(*choice.alpha);
    if (choice.axial != 0) slices.axialCount = choice.axial;
    if (choice.diagonal != 0) slices.diagonalCount = choice.diagonal;
    return slices;
}

bool isUbo81(const std::vector<Direction>& directions) {
    const std::vector<Direction> ubo = ubo81Directions();
    constexpr Radians kClose = radiansFromDegrees(1);
    return directions.size() == ubo.size() && std::ranges::all_of(ubo, [&](Direction d) {
               return angleBetween(d, directions[nearestDirection(directions, d)]) < kClose;
           });
}

std::vector<std::size_t> computedGreedyPairs(const AngularGrid& grid, std::size_t count,
                                             std::vector<std::size_t> first,
                                             const ProgressSink& progress,
                                             const MessageSink& warn) {
    std::string key = "greedy pairs 4";
    for (const LightAndView& pair : pairsOf(grid)) {
        key += fmt::format(" {:.6f} {:.6f} {:.6f} {:.6f}", pair.light.theta, pair.light.phi,
                           pair.view.theta, pair.view.phi);
    }
    key += fmt::format(" {}", count);
    const auto choose = [&] {
        GreedyOptions options;
        options.count = count;
        options.first = std::move(first);
        options.materials = greedyMaterials(grid.pairCount());
        const GreedyChoice choice = greedyPairs(grid, {}, options, progress);
        return ChosenPairs{choice.pairs, expectedErrorsOf(choice.deviation)};
    };
    return cachedChoice(key, count, grid.pairCount(), choose, warn).pairs;
}

SamplePlan greedyPlan(const PlanName& name, const AngularGrid& measured,
                      const ProgressSink& progress, const MessageSink& warn) {
    const std::size_t count =
        std::min(name.bound > 0 ? name.bound : kPlanSamples, measured.pairCount());
    const std::string full = name.bound > 0 ? fmt::format("greedy:{}", name.bound) : "greedy";
    const bool isUbo = isUbo81(measured.lights()) && isUbo81(measured.views());
    const AngularGrid grid = isUbo ? AngularGrid(ubo81Directions()) : measured;
    // A longer plan goes on where the one built in ends.
    std::vector<std::size_t> pairs = isUbo ? greedyPairsOfUbo81() : std::vector<std::size_t>();
    if (pairs.size() < count) {
        pairs = computedGreedyPairs(grid, count, std::move(pairs), progress, warn);
    }
    pairs.resize(count);
    return pairsPlan(full, grid, pairs);
}

/// The first samples of a plan in a file.
SamplePlan filePlan(const PlanName& name) {
    SamplePlan plan = planFromFile(name.base);
    if (name.bound > 0 && name.bound < plan.samples.size()) {
        plan.samples.resize(name.bound);
        plan.name += fmt::format(":{}", name.bound);
    }
    return plan;
}

SamplePlan snapped(const SamplePlan& plan, double degrees, const AngularGrid& measured,
                   std::span<const std::uint8_t> present, const MessageSink& warn) {
    SnappedPlan result = snapPlan(plan, measured, present, radiansFromDegrees(degrees));
    if (result.stoodIn > 0 && warn) {
        warn(
            fmt::format("{} samples of the plan {} have no image; the nearest measured pairs "
                        "within {:g} degrees stand for them",
                        result.stoodIn, plan.name, degrees));
    }
    return std::move(result.plan);
}

/// A choice with what it leaves open filled in.
struct NamedChoice {
    PlanName name;
    bool isFile = false;
};

NamedChoice namedChoice(const Method& method, const PlanChoice& choice) {
    const bool needsPoster = method.wish == SampleWish::kSlices;
    const std::string own = needsPoster || hasPosterNumbers(choice) ? "poster" : "eight";
    NamedChoice named;
    named.isFile = !choice.name.empty() && fs::is_regular_file(choice.name);
    if (named.isFile) {
        named.name = {choice.name, 0};
    } else {
        named.name = planNameFrom(choice.name.empty() ? own : choice.name);
        named.isFile = named.name.bound > 0 && fs::is_regular_file(named.name.base);
    }
    constexpr std::array kNames = {"eight", "poster", "slices16", "greedy"};
    if (!named.isFile && std::ranges::find(kNames, named.name.base) == kNames.end()) {
        throw std::invalid_argument(
            fmt::format("there is no plan '{}': use eight, poster, slices16 or greedy, with :N for "
                        "at most N samples, or a file from abrdf plan",
                        named.name.base));
    }
    if (choice.snap && !(*choice.snap >= 0 && *choice.snap <= 180)) {
        throw std::invalid_argument(
            fmt::format("--snap {:g} is no angle: give degrees from 0 to 180", *choice.snap));
    }
    if (hasPosterNumbers(choice) && named.name.base != "poster") {
        throw std::invalid_argument(
            fmt::format("--elevations, --alpha, --axial and --diagonal are numbers of the plan "
                        "poster, not of {}; write --plan poster with them",
                        named.name.base));
    }
    return named;
}

}  // namespace

void checkPlanChoice(const Method& method, const PlanChoice& choice) {
    const NamedChoice named = namedChoice(method, choice);
    if (named.name.base == "poster") checkPlan(posterSlices(choice, named.name.bound));
}

SamplePlan planFor(const Method& method, const PlanChoice& choice, const AngularGrid& measured,
                   std::span<const std::uint8_t> present, bool anywhere,
                   const ProgressSink& progress, const MessageSink& warn) {
    const auto [name, isFile] = namedChoice(method, choice);
    const bool needsSlices = method.wish == SampleWish::kSlices;
    if (name.base == "poster" && (needsSlices || !choice.snap)) {
        return posterPlan(posterSlices(choice, name.bound));
    }
    if (needsSlices) {
        const std::size_t bound = name.bound > 0 ? name.bound : kPlanSamples;
        if (warn) {
            warn(
                fmt::format("the method {} needs the poster's slices: it takes the plan poster "
                            "with at most {} samples instead of {}",
                            method.name, bound, name.base));
        }
        return posterPlan(posterSlices(choice, bound));
    }
    const AngularGrid* snapTo = anywhere ? nullptr : &measured;
    SamplePlan plan = isFile                    ? filePlan(name)
                      : name.base == "eight"    ? eightPlan(name.bound, snapTo)
                      : name.base == "poster"   ? posterPlan(posterSlices(choice, name.bound))
                      : name.base == "slices16" ? sixteenSlicesPlan(name.bound, snapTo)
                                                : greedyPlan(name, measured, progress, warn);
    if (anywhere || (!isFile && !choice.snap)) return plan;
    return snapped(plan, choice.snap.value_or(kFileSnap), measured, present, warn);
}

}  // namespace abrdf
