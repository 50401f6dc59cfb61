// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress_setup.h"

#include "abrdf/pair_interpolation.h"
#include "pipeline/input_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// The average of a database as a material: exact at its pairs, interpolated between them.
StressMaterial measuredMaterial(const fs::path& path, const StressOptions& options,
                                const ProgressSink& progress, const MessageSink& warn) {
    InputOptions inputOptions;
    inputOptions.input = path;
    inputOptions.colorConfig = options.colorConfig;
    inputOptions.warn = warn;
    const OpenedInput input = openInput(inputOptions);
    const AngularGrid grid = input.description().grid;
    const SampleSet everything = samplesFor(methodFromName("measured"), {}, input, grid);
    const ReadStack read = readStack(input, everything, {1, 1}, {}, progress);
    auto values = std::make_shared<std::vector<Rgb>>(
        meanSamples(read.stack.pairs(), read.facts.means, everything));
    input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)").apply(*values);
    for (Rgb& c : *values) c = {std::max(c.r, 0.0F), std::max(c.g, 0.0F), std::max(c.b, 0.0F)};
    auto between = std::make_shared<const PairInterpolation>(grid);
    return {path.filename().string(), [values, between](const LightAndView& pair) {
                Rgb sum;
                for (const WeightedPair& term : between->weights(pair)) {
                    sum += term.weight * (*values)[term.pair];
                }
                return sum;
            }};
}

std::vector<StressCase> chosenCases(const StressOptions& options) {
    std::vector<StressCase> all = stressCases();
    std::vector<StressCase> chosen;
    for (const std::string& name : options.cases) {
        const auto found = std::ranges::find(all, name, &StressCase::name);
        if (found == all.end()) {
            std::string names;
            for (const StressCase& c : all) names += " " + c.name;
            throw std::invalid_argument(
                fmt::format("there is no case '{}'; the cases are:{}", name, names));
        }
        chosen.push_back(*found);
    }
    if (!options.cases.empty()) return chosen;
    if (options.inputs.empty()) return all;
    std::erase_if(all, [](const StressCase& c) { return !c.ofAnyMaterial; });
    return all;
}

std::vector<StressMethod> chosenMethods(const StressOptions& options, const AngularGrid& grid,
                                        const ProgressSink& progress, const MessageSink& warn) {
    std::vector<std::string> names = options.methods;
    if (names.empty()) {
        for (const Method& method : methods()) {
            if (method.wish != SampleWish::kEverything) names.emplace_back(method.name);
        }
    }
    std::vector<StressMethod> chosen;
    for (const std::string& name : names) {
        const Method& method = methodFromName(name);
        if (method.wish == SampleWish::kEverything) {
            throw std::invalid_argument(
                fmt::format("the method {} reconstructs nothing, so nothing can fail it", name));
        }
        const bool ownPlan = method.wish == SampleWish::kSlices;
        chosen.push_back({&method, planFor(method, ownPlan ? PlanChoice{} : options.plan, grid, {},
                                           false, progress, warn)});
    }
    return chosen;
}

}  // namespace

StressSetup setUpStress(const StressOptions& options, const ProgressSink& progress,
                        const MessageSink& warn) {
    StressSetup setup;
    setup.cases = chosenCases(options);
    setup.grid = gridFromName(options.grid);
    setup.methods = chosenMethods(options, setup.grid, progress, warn);
    for (const fs::path& input : options.inputs) {
        setup.materials.push_back(measuredMaterial(input, options, progress, warn));
    }
    if (setup.materials.empty()) setup.materials = stressMaterials();
    return setup;
}

}  // namespace abrdf
