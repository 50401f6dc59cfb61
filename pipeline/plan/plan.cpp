// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan.h"

#include "abrdf/angular_grid.h"
#include "abrdf/goniometer.h"
#include "abrdf/output_file.h"
#include "abrdf/scene_pairs.h"
#include "abrdf/stopwatch.h"
#include "pipeline/plan/expected_error.h"
#include "pipeline/plan/plan_file.h"
#include "stages/read/btf_reader.h"
#include "stages/train/greedy_pairs.h"
#include "stages/train/greedy_slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace abrdf {

namespace {

using nlohmann::ordered_json;

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

/// A plan with all that is told of it.
struct Planned {
    SamplePlan plan;
    std::vector<double> errors;  ///< Expected after each sample.
    std::size_t candidates = 0;
    std::vector<Slice> slices = {};
    std::vector<std::size_t> sweep = {};   ///< The order in which to measure.
    std::optional<double> freeError = {};  ///< Of as many single samples.
    Travel freeTravel = {};
};

Planned pairsOf(const PlanJob& job, const Choosable& from, const ProgressSink& progress) {
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
    Planned planned{{fmt::format("greedy-{}", from.name), {}, {}},
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

Planned slicesFor(const PlanJob& job, const Choosable& from, const ProgressSink& progress) {
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
    Planned planned{{fmt::format("slices-{}", from.name), {}, {}},
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

double degreesOf(Radians angle) {
    return std::round(10 * degreesFromRadians(angle)) / 10;
}

ordered_json jsonOf(const Travel& travel) {
    return {{"light", degreesOf(travel.light)},
            {"sensor", degreesOf(travel.sensor)},
            {"sample", degreesOf(travel.sample)}};
}

ordered_json jsonOf(const Slice& slice) {
    return {{"kind", slice.kind == SliceKind::kAxial ? "axial" : "diagonal"},
            {"theta_i", degreesOf(slice.thetaLight)},
            {"theta_v", degreesOf(slice.thetaView)},
            {"alpha", degreesOf(slice.offset)},
            {"samples", slice.count}};
}

Travel sweptTravel(const Planned& planned) {
    std::vector<LightAndView> swept;
    for (const std::size_t i : planned.sweep) swept.push_back(planned.plan.samples[i]);
    return travelOf(swept);
}

ordered_json stepsOf(const std::vector<double>& errors) {
    ordered_json steps = ordered_json::array();
    for (std::size_t count : {8U, 16U, 28U, 52U, 100U, 204U, 408U, 816U}) {
        if (count >= errors.size()) break;
        steps.push_back({{"samples", count}, {"delta_e", errors[count - 1]}});
    }
    steps.push_back({{"samples", errors.size()}, {"delta_e", errors.back()}});
    return steps;
}

std::string fileText(const Planned& planned, const Travel& travel) {
    PlanNotes notes;
    notes.expectedError = planned.errors;
    notes.sweep = planned.sweep;
    notes.comments = {
        fmt::format("abrdf {} plan: every prefix is a plan; FILE:N takes the first N samples",
                    ABRDF_VERSION),
        fmt::format("in the order of `sweep` the light turns by {:.0f}, the sensor by {:.0f}, the "
                    "sample by {:.0f} degrees",
                    degreesFromRadians(travel.light), degreesFromRadians(travel.sensor),
                    degreesFromRadians(travel.sample))};
    for (const Slice& slice : planned.slices) {
        const ordered_json s = jsonOf(slice);
        notes.comments.push_back(fmt::format("{} theta_i {:g} theta_v {:g} alpha {:g}: {} samples",
                                             s["kind"].get<std::string>(),
                                             s["theta_i"].get<double>(), s["theta_v"].get<double>(),
                                             s["alpha"].get<double>(), slice.count));
    }
    return planText(planned.plan, notes);
}

}  // namespace

ordered_json plan(const PlanJob& job, const ProgressSink& progress) {
    if (job.samples < 1 || job.samples > 5000) {
        throw std::invalid_argument(
            fmt::format("--samples {} is not possible: choose 1 to 5000", job.samples));
    }
    if (!(job.travel >= 0 && job.travel <= 1e6)) {
        throw std::invalid_argument("--travel is a number of samples, 0 or more");
    }
    checkOutputPath(job.output);
    const Stopwatch time;
    const Choosable from = choosable(job);
    const Planned planned =
        job.continuous ? slicesFor(job, from, progress) : pairsOf(job, from, progress);
    const Travel travel = sweptTravel(planned);
    writeWholeFile(job.output, fileText(planned, travel));
    const auto enough = whereMoreStopPaying(planned.errors);
    ordered_json report = {
        {"command", "plan"},
        {"version", ABRDF_VERSION},
        {"plan", {{"name", planned.plan.name}, {"samples", planned.plan.samples.size()}}},
        {"grid", {{"lights", from.grid.lights().size()}, {"views", from.grid.views().size()}}},
        {"candidates", planned.candidates},
        {"expected_error", planned.errors},
        {"steps", stepsOf(planned.errors)},
        {"enough", enough ? ordered_json(*enough) : ordered_json()},
        {"travel", jsonOf(travel)}};
    if (planned.freeError) {
        report["free"] = {{"delta_e", *planned.freeError}, {"travel", jsonOf(planned.freeTravel)}};
        report["slices"] = ordered_json::array();
        for (const Slice& slice : planned.slices) report["slices"].push_back(jsonOf(slice));
    }
    report["output"] = {{"path", job.output.string()},
                        {"bytes", std::filesystem::file_size(job.output)}};
    report["time"] = time.seconds();
    return report;
}

std::string planSummary(const ordered_json& report) {
    const auto travelText = [](const ordered_json& travel) {
        return fmt::format("light {:.0f}, sensor {:.0f}, sample {:.0f} degrees",
                           travel["light"].get<double>(), travel["sensor"].get<double>(),
                           travel["sample"].get<double>());
    };
    std::string text = "samples  expected Delta E\n";
    for (const ordered_json& step : report["steps"]) {
        text += fmt::format("{:7}  {:.2f}\n", step["samples"].get<std::size_t>(),
                            step["delta_e"].get<double>());
    }
    text += report["enough"].is_null()
                ? std::string("more samples pay to the end\n")
                : fmt::format("from {} samples on twice as many gain less than 10 % or 0.1\n",
                              report["enough"].get<std::size_t>());
    text += fmt::format("travel: {}\n", travelText(report["travel"]));
    if (report.contains("free")) {
        text +=
            fmt::format("{} slices; as many single samples at their places: {:.2f}, travel: {}\n",
                        report["slices"].size(), report["free"]["delta_e"].get<double>(),
                        travelText(report["free"]["travel"]));
    }
    return text +
           fmt::format("{}: {} samples, {:.1f} s\n", report["output"]["path"].get<std::string>(),
                       report["plan"]["samples"].get<std::size_t>(), report["time"].get<double>());
}

}  // namespace abrdf
