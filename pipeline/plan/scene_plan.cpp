// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/scene_plan.h"

#include "pipeline/plan/expected_error.h"
#include "pipeline/plan/greedy_cache.h"
#include "stages/train/greedy_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace {

/// Fewer samples say little of a material but at themselves.
constexpr std::size_t kLeastSamples = 8;

/// The pairs of the output grid that matter.
struct Shown {
    std::vector<LightAndView> pairs;
    std::vector<double> weights;
};

Shown shownOf(const SceneOutputs& scene, const AngularGrid& output) {
    Shown shown;
    for (std::size_t pair = 0; pair < output.pairCount(); ++pair) {
        if (scene.weights[pair] <= 0) continue;
        shown.pairs.push_back(output.pair(pair));
        shown.weights.push_back(scene.weights[pair]);
    }
    return shown;
}

std::vector<std::size_t> presentPairs(const AngularGrid& measured,
                                      std::span<const std::uint8_t> present) {
    std::vector<std::size_t> pairs;
    for (std::size_t pair = 0; pair < measured.pairCount(); ++pair) {
        if (present.empty() || present[pair] != 0) pairs.push_back(pair);
    }
    return pairs;
}

std::string keyOf(const Shown& shown, const AngularGrid& measured,
                  const std::vector<std::size_t>& candidates, std::size_t count) {
    const auto text = [](const LightAndView& pair) {
        return fmt::format(" {:.6f} {:.6f} {:.6f} {:.6f}", pair.light.theta, pair.light.phi,
                           pair.view.theta, pair.view.phi);
    };
    std::string key = fmt::format("scene pairs 1 {}", count);
    for (std::size_t i = 0; i < shown.pairs.size(); ++i) {
        key += text(shown.pairs[i]) + fmt::format(" {:.9f}", shown.weights[i]);
    }
    for (const std::size_t pair : candidates) key += text(measured.pair(pair));
    return key;
}

/// The measured pairs that are the shown ones; none where some are not measured.
std::vector<std::size_t> measuredOf(const Shown& shown, const AngularGrid& measured,
                                    const std::vector<std::size_t>& candidates) {
    constexpr double kSame = 1e-7;  // Squared distance on both spheres: .02 degrees.
    const NearestDirection lights(measured.lights());
    const NearestDirection views(measured.views());
    std::vector<std::size_t> pairs;
    for (const LightAndView& wanted : shown.pairs) {
        const std::size_t pair =
            measured.pairIndex(lights.indexOf(wanted.light), views.indexOf(wanted.view));
        if (squaredDistance(measured.pair(pair), wanted) > kSame ||
            !std::ranges::binary_search(candidates, pair)) {
            return {};
        }
        pairs.push_back(pair);
    }
    return pairs;
}

/// How many of the samples are worth their images.
std::size_t countWorthwhile(const std::vector<double>& errors, double tolerance) {
    const std::size_t least = std::min(kLeastSamples, errors.size());
    std::size_t count = whereMoreStopPaying(errors).value_or(errors.size());
    if (tolerance > 0) {
        const auto within =
            std::ranges::find_if(errors, [&](double error) { return error <= tolerance; });
        count = std::min(static_cast<std::size_t>(within - errors.begin()) + 1, errors.size());
    }
    return std::max(count, least);
}

}  // namespace

ScenePlan scenePlan(const SceneOutputs& scene, const AngularGrid& output,
                    const AngularGrid& measured, std::span<const std::uint8_t> present,
                    const ScenePlanOptions& options, const ProgressSink& progress,
                    const MessageSink& warn) {
    const Shown shown = shownOf(scene, output);
    const std::vector<std::size_t> candidates = presentPairs(measured, present);
    if (candidates.empty()) throw std::invalid_argument("there is no image to choose from");
    const std::size_t count = std::min(options.bound, candidates.size());
    const auto choose = [&] {
        GreedyOptions greedy;
        greedy.count = count;
        greedy.materials = greedyMaterials(measured.pairCount());
        const GreedyChoice choice =
            greedyPairs(measured, candidates, watchedPairs(measured, shown.pairs, shown.weights),
                        greedy, progress);
        return ChosenPairs{choice.pairs, expectedErrorsOf(choice.deviation)};
    };
    ChosenPairs chosen = cachedChoice(keyOf(shown, measured, candidates, count), count,
                                      measured.pairCount(), choose, warn);
    if (options.mayBeFewer) chosen.pairs.resize(countWorthwhile(chosen.errors, options.tolerance));
    // Where it takes no more images, what is shown is taken itself.
    const std::vector<std::size_t> own = measuredOf(shown, measured, candidates);
    if (options.mayBeFewer && !own.empty() && own.size() <= chosen.pairs.size()) {
        return {pairsPlan(fmt::format("{}:{}", scene.name, own.size()), measured, own), 0};
    }
    return {pairsPlan(fmt::format("greedy-{}:{}", scene.name, chosen.pairs.size()), measured,
                      chosen.pairs),
            chosen.errors[chosen.pairs.size() - 1]};
}

}  // namespace abrdf
