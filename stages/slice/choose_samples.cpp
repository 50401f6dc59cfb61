// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/choose_samples.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

namespace abrdf {

namespace {

void collectPairs(SampleSet& set) {
    set.pairs.clear();
    for (const auto& sources : set.sources) {
        for (const WeightedPair& source : sources) set.pairs.push_back(source.pair);
    }
    std::ranges::sort(set.pairs);
    set.pairs.erase(std::unique(set.pairs.begin(), set.pairs.end()), set.pairs.end());
}

void addMeasuredPair(SampleSet& set, const AngularGrid& grid, std::size_t pair) {
    set.directions.push_back(grid.pair(pair));
    set.sources.push_back({{pair, 1.0F}});
}

std::vector<WeightedPair> neighbours(std::size_t pair, const AngularGrid& grid,
                                     std::span<const std::uint8_t> present) {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t other = 0; other < present.size(); ++other) {
        if (present[other] != 0) {
            found.emplace_back(squaredDistance(grid.pair(pair), grid.pair(other)), other);
        }
    }
    if (found.empty())
        throw std::runtime_error("no image is left to interpolate missing ones from");
    const std::size_t count = std::min<std::size_t>(4, found.size());
    std::ranges::partial_sort(found, found.begin() + static_cast<std::ptrdiff_t>(count));
    found.resize(count);
    double sum = 0;
    // Two pairs at one place (a pole that is listed twice) have distance 0.
    for (auto& [distance, other] : found) sum += 1 / std::max(distance, 1e-12);
    std::vector<WeightedPair> weighted;
    for (const auto& [distance, other] : found) {
        weighted.push_back({other, static_cast<float>(1 / std::max(distance, 1e-12) / sum)});
    }
    return weighted;
}

}  // namespace

SampleSet chooseSamples(const SamplePlan& plan, const AngularGrid& grid, SampleWish wish) {
    SampleSet set;
    if (wish == SampleWish::kEverything) {
        for (std::size_t pair = 0; pair < grid.pairCount(); ++pair)
            addMeasuredPair(set, grid, pair);
    } else if (wish == SampleWish::kSlices) {
        if (!plan.posterSlices) throw std::invalid_argument("the plan has no slices");
        const PairInterpolation interpolation(grid);
        set.directions = plan.posterSlices->samples();
        for (const LightAndView& wanted : set.directions) {
            set.sources.push_back(interpolation.weights(wanted));
        }
    } else {
        const NearestDirection lights(grid.lights());
        const NearestDirection views(grid.views());
        std::set<std::size_t> nearest;
        for (const LightAndView& wanted : plan.samples) {
            nearest.insert(
                grid.pairIndex(lights.indexOf(wanted.light), views.indexOf(wanted.view)));
        }
        for (const std::size_t pair : nearest) addMeasuredPair(set, grid, pair);
    }
    collectPairs(set);
    return set;
}

SampleSet samplesOfPairs(const AngularGrid& grid, const std::vector<std::size_t>& pairs) {
    SampleSet set;
    for (const std::size_t pair : pairs) addMeasuredPair(set, grid, pair);
    collectPairs(set);
    return set;
}

SampleSet exactSamples(std::vector<LightAndView> directions) {
    SampleSet set;
    set.directions = std::move(directions);
    for (std::size_t k = 0; k < set.directions.size(); ++k) {
        set.sources.push_back({{k, 1.0F}});
        set.pairs.push_back(k);
    }
    return set;
}

std::vector<std::size_t> missingPairs(const SampleSet& set, std::span<const std::uint8_t> present) {
    std::vector<std::size_t> missing;
    for (const std::size_t pair : set.pairs) {
        if (present[pair] == 0) missing.push_back(pair);
    }
    return missing;
}

SampleSet dropMissing(SampleSet set, std::span<const std::uint8_t> present) {
    SampleSet kept;
    for (std::size_t k = 0; k < set.count(); ++k) {
        const bool isThere = std::ranges::all_of(
            set.sources[k], [&](const WeightedPair& source) { return present[source.pair] != 0; });
        if (!isThere) {
            kept.dropped.push_back(set.directions[k]);
            continue;
        }
        kept.directions.push_back(set.directions[k]);
        kept.sources.push_back(std::move(set.sources[k]));
    }
    if (kept.count() == 0) throw std::runtime_error("none of the plan's images is present");
    kept.filled = kept.dropped.size();
    collectPairs(kept);
    return kept;
}

SampleSet fillMissing(SampleSet set, const AngularGrid& grid,
                      std::span<const std::uint8_t> present) {
    const std::vector<std::size_t> missing = missingPairs(set, present);
    std::map<std::size_t, std::vector<WeightedPair>> replacement;
    for (const std::size_t pair : missing) replacement[pair] = neighbours(pair, grid, present);
    for (auto& sources : set.sources) {
        std::vector<WeightedPair> filled;
        for (const WeightedPair& source : sources) {
            const auto found = replacement.find(source.pair);
            if (found == replacement.end()) {
                filled.push_back(source);
                continue;
            }
            for (const WeightedPair& neighbour : found->second) {
                filled.push_back({neighbour.pair, source.weight * neighbour.weight});
            }
        }
        sources = std::move(filled);
    }
    set.filled = missing.size();
    collectPairs(set);
    return set;
}

}  // namespace abrdf
