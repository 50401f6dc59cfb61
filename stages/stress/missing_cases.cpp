// SPDX-License-Identifier: BSD-3-Clause
//
// Samples that are not there: at random, or all that one fault of a rig takes away.
#include "stages/stress/stress_case.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace abrdf {

namespace {

using Key = std::pair<long, long>;
using KeyOf = Key (*)(const LightAndView& pair);

long rounded(Radians angle) {
    return std::lround(degreesFromRadians(angle) / 2);
}

Key subspaceOf(const LightAndView& pair) {
    return {rounded(pair.light.theta), rounded(pair.view.theta)};
}

Key lightOf(const LightAndView& pair) {
    return {rounded(pair.light.theta), rounded(wrappedAzimuth(pair.light.phi))};
}

/// The groups of the samples, those of most samples first.
std::vector<Key> largestGroups(std::span<const LightAndView> samples, KeyOf keyOf) {
    std::map<Key, std::size_t> counts;
    for (const LightAndView& sample : samples) ++counts[keyOf(sample)];
    std::vector<std::pair<Key, std::size_t>> sorted(counts.begin(), counts.end());
    std::ranges::stable_sort(sorted,
                             [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<Key> keys;
    for (const auto& [key, count] : sorted) keys.push_back(key);
    return keys;
}

/// Leaves out the `count` largest groups, but never all of them.
StressTrial withoutGroups(const StressMaterial& material, double count, KeyOf keyOf) {
    StressTrial trial;
    trial.truth = material;
    trial.kept = [count, keyOf](std::span<const LightAndView> samples, Random&) {
        const std::vector<Key> groups = largestGroups(samples, keyOf);
        const std::size_t gone = std::min(static_cast<std::size_t>(count), groups.size() - 1);
        const std::set<Key> lost(groups.begin(),
                                 groups.begin() + static_cast<std::ptrdiff_t>(gone));
        std::vector<bool> kept;
        for (const LightAndView& sample : samples) kept.push_back(!lost.contains(keyOf(sample)));
        return kept;
    };
    return trial;
}

StressTrial dropped(const StressMaterial& material, double share) {
    StressTrial trial;
    trial.truth = material;
    trial.kept = [share](std::span<const LightAndView> samples, Random& random) {
        std::vector<std::size_t> order(samples.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        for (std::size_t i = order.size(); i > 1; --i)
            std::swap(order[i - 1], order[random.below(i)]);
        const auto gone = std::min(
            static_cast<std::size_t>(std::lround(share * static_cast<double>(samples.size()))),
            samples.size() - 1);
        std::vector<bool> kept(samples.size(), true);
        for (std::size_t i = 0; i < gone; ++i) kept[order[i]] = false;
        return kept;
    };
    return trial;
}

}  // namespace

std::vector<StressCase> missingCases() {
    return {
        {"missing", "samples missing at random", "share", true, false,
         stepsOf({0, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95}, 100, " %"), dropped},
        {"missing-slice", "half of a subspace missing, as one slice of two", "subspaces", true,
         false, stepsOf({0, 1, 2, 3, 4}),
         [](const StressMaterial& material, double count) {
             StressTrial trial;
             trial.truth = material;
             trial.kept = [count](std::span<const LightAndView> samples, Random&) {
                 const std::vector<Key> groups = largestGroups(samples, subspaceOf);
                 const std::size_t hit = std::min(static_cast<std::size_t>(count), groups.size());
                 const std::set<Key> halved(groups.begin(),
                                            groups.begin() + static_cast<std::ptrdiff_t>(hit));
                 std::vector<bool> kept;
                 for (const LightAndView& s : samples) {
                     // Light and view within a right angle of one another: the mirror side stays.
                     const bool isNear = std::cos(s.light.phi - s.view.phi) > 0;
                     kept.push_back(!(isNear && halved.contains(subspaceOf(s))));
                 }
                 if (std::ranges::find(kept, true) == kept.end()) kept[0] = true;
                 return kept;
             };
             return trial;
         }},
        {"missing-subspace", "whole subspaces missing", "subspaces", true, false,
         stepsOf({0, 1, 2, 3}),
         [](const StressMaterial& material, double count) {
             return withoutGroups(material, count, subspaceOf);
         }},
        {"missing-light", "all samples of some lights missing", "lights", true, false,
         stepsOf({0, 1, 2, 4, 8, 16}),
         [](const StressMaterial& material, double count) {
             return withoutGroups(material, count, lightOf);
         }},
    };
}

}  // namespace abrdf
