// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/planned_samples.h"

#include "abrdf/scene_pairs.h"
#include "pipeline/plan/expected_error.h"
#include "stages/read/btf_reader.h"
#include "stages/train/greedy_pairs.h"
#include "stages/train/greedy_slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace abrdf {

namespace {

/// More pairs than any grid of ours has: a list of single images.
constexpr std::size_t kMostPairs = 100000;

/// What may be chosen, and over which pairs uncertainty counts.
struct Choosable {
    std::string name;
    AngularGrid grid;
    std::vector<LightAndView> candidates = {};  ///< Empty: all pairs of the grid.
    WatchedPairs watched = {};

    std::size_t count() const { return candidates.empty() ? grid.pairCount() : candidates.size(); }
};

Choosable allPairs(const PlanJob& job) {
    if (job.input.empty()) {
        const std::filesystem::path name(job.grid);
        return {name.stem().string(), gridFromName(job.grid)};
    }
    const auto reader = openBtf(job.input, job.read);
    const BtfDescription& description = reader->description();
    Choosable result{description.source, description.grid};
    if (std::ranges::count(description.present, std::uint8_t{0}) > 0) {
        for (std::size_t pair = 0; pair < description.present.size(); ++pair) {
            if (description.present[pair] != 0) {
                result.candidates.push_back(description.grid.pair(pair));
            }
        }
    }
    if (result.grid.pairCount() > kMostPairs) result.grid = AngularGrid(ubo81Directions());
    return result;
}

Choosable choosable(const PlanJob& job) {
    Choosable result = allPairs(job);
    if (job.pairs.empty()) {
        result.watched = watchedPairs(result.grid, job.seed);
    } else {
        const ScenePairs scene = scenePairsFromCsv(job.pairs);
        result.name = scene.name;
        result.watched = watchedPairs(result.grid, scene.pairs, scene.weights);
    }
    return result;
}

std::size_t materialsFor(const PlanJob& job, std::size_t pairs) {
    if (job.materials > 0) return job.materials;
    return greedyMaterials(pairs);
}

PlannedSamples singlePairs(const PlanJob& job, const Choosable& from,
                           const ProgressSink& progress) {
    if (job.samples > from.count()) {
        throw std::invalid_argument(
            fmt::format("there are only {} pairs to choose from in {}, not {}; ask for fewer with "
                        "--samples",
                        from.count(), from.name, job.samples));
    }
    const std::size_t materials = materialsFor(job, from.grid.pairCount() + from.candidates.size());
    const GreedyChoice choice = greedyPairs(
        conditionedClasses(from.grid, from.watched, from.candidates, {materials, job.seed}),
        {.count = job.samples, .materials = materials, .seed = job.seed}, progress);
    PlannedSamples planned{{fmt::format("greedy-{}", from.name), {}, {}},
                           from.grid,
                           expectedErrorsOf(choice.deviation),
                           from.count()};
    std::vector<std::vector<LightAndView>> singles;
    for (const std::size_t i : choice.pairs) {
        planned.plan.samples.push_back(from.candidates.empty() ? from.grid.pair(i)
                                                               : from.candidates[i]);
        singles.push_back({planned.plan.samples.back()});
    }
    planned.sweep = sweptOrder(singles);
    return planned;
}

PlannedSamples wholeSlices(const PlanJob& job, const Choosable& from,
                           const ProgressSink& progress) {
    SliceFamily family;
    const std::vector<double> own = {15, 30, 45, 60, 75};
    for (const double degrees : job.elevations.empty() ? own : job.elevations) {
        family.elevations.push_back(radiansFromDegrees(degrees));
    }
    const std::vector<Slice> slices = slicesOf(family);
    std::size_t pairs = from.grid.pairCount();
    for (const Slice& slice : slices) pairs += static_cast<std::size_t>(slice.count);
    const GreedySlices choice = greedySlices(from.grid, from.watched, slices,
                                             {.count = job.samples,
                                              .materials = materialsFor(job, pairs),
                                              .seed = job.seed,
                                              .travel = job.travel,
                                              .free = true},
                                             progress);
    PlannedSamples planned{{fmt::format("slices-{}", from.name), {}, {}},
                           from.grid,
                           expectedErrorsOf(choice.deviation),
                           slices.size(),
                           choice.slices};
    std::vector<std::vector<LightAndView>> samples;
    for (const Slice& slice : choice.slices) {
        samples.push_back(samplesOf(slice));
        planned.plan.samples.insert(planned.plan.samples.end(), samples.back().begin(),
                                    samples.back().end());
    }
    planned.sweep = sweptOrder(samples);
    const std::size_t count = planned.errors.size();
    planned.freeError = expectedErrorOf(choice.freeDeviation[count - 1]);
    std::vector<std::vector<LightAndView>> singles;
    for (std::size_t i = 0; i < count; ++i) singles.push_back({choice.freeSamples[i]});
    std::vector<LightAndView> swept;
    for (const std::size_t i : sweptOrder(singles)) swept.push_back(choice.freeSamples[i]);
    planned.freeTravel = travelOf(swept);
    return planned;
}

}  // namespace

Travel PlannedSamples::sweptTravel() const {
    std::vector<LightAndView> swept;
    for (const std::size_t i : sweep) swept.push_back(plan.samples[i]);
    return travelOf(swept);
}

PlannedSamples planSamples(const PlanJob& job, const ProgressSink& progress) {
    const Choosable from = choosable(job);
    return job.continuous ? wholeSlices(job, from, progress) : singlePairs(job, from, progress);
}

}  // namespace abrdf
