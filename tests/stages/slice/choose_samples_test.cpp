// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/choose_samples.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace abrdf;

namespace {

/// What the sources of sample k make of a function of directions.
template <typename Function>
double valueOf(const SampleSet& set, const AngularGrid& grid, std::size_t k, const Function& f) {
    double value = 0;
    for (const WeightedPair& source : set.sources[k]) {
        value += static_cast<double>(source.weight) * f(grid.pair(source.pair));
    }
    return value;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("samples of slices are at the plan's places, in the plan's order, on any grid") {
    for (const auto& directions :
         {ubo81Directions(), dome151Directions(), regularDirections(6, 48)}) {
        const AngularGrid grid(directions);
        for (const char* name : {"poster", "poster:100", "poster:8"}) {
            const SlicePlan plan = slicePlanFromName(name);
            const SampleSet set = chooseSamples(posterPlan(plan), grid, SampleWish::kSlices);
            CHECK(set.directions == plan.samples());
            for (std::size_t k = 0; k < set.count(); ++k) {
                const LightAndView at = set.directions[k];
                CHECK(valueOf(set, grid, k, [](const LightAndView& p) {
                          return p.light.theta - 3 * p.view.theta;
                      }) == doctest::Approx(at.light.theta - 3 * at.view.theta).epsilon(1e-5));
                // Chords of at most 30 degrees, of light and view each: a smooth wave is met to
                // 1 - cos 15 = 3.4 % along one, and to twice that along both.
                CHECK(std::abs(valueOf(set, grid, k,
                                       [](const LightAndView& p) { return std::cos(p.view.phi); }) -
                               std::cos(at.view.phi)) < 0.069);
            }
        }
    }
}

TEST_CASE("the poster's samples on ubo81 come from its own two elevations only") {
    const AngularGrid grid(ubo81Directions());
    const SampleSet set = chooseSamples(posterPlan({}), grid, SampleWish::kSlices);
    std::set<int> thetas;
    for (const std::size_t pair : set.pairs) {
        thetas.insert(
            static_cast<int>(std::lround(degreesFromRadians(grid.pair(pair).light.theta))));
        thetas.insert(
            static_cast<int>(std::lround(degreesFromRadians(grid.pair(pair).view.theta))));
    }
    CHECK(thetas == std::set<int>{30, 75});
}

TEST_CASE("everything is every pair once, in its order") {
    const AngularGrid grid(regularDirections(2, 3), regularDirections(3, 5));
    const SampleSet set = chooseSamples(posterPlan({}), grid, SampleWish::kEverything);
    REQUIRE(set.count() == grid.pairCount());
    for (std::size_t k = 0; k < set.count(); ++k) {
        CHECK(set.pairs[k] == k);
        CHECK(set.directions[k] == grid.pair(k));
        REQUIRE(set.sources[k].size() == 1);
        CHECK(set.sources[k][0].pair == k);
        CHECK(set.sources[k][0].weight == 1);
    }
}

TEST_CASE("however many pairs are missing, only present ones are left, and a constant stays one") {
    const AngularGrid grid(ubo81Directions());
    const SampleSet whole = chooseSamples(posterPlan({}), grid, SampleWish::kSlices);
    for (const std::size_t keepEvery : {std::size_t{2}, std::size_t{10}, std::size_t{6000}}) {
        std::vector<std::uint8_t> present(grid.pairCount(), 0);
        for (std::size_t pair = 0; pair < present.size(); pair += keepEvery) present[pair] = 1;
        const std::size_t missing = missingPairs(whole, present).size();
        const SampleSet filled = fillMissing(whole, grid, present);
        CHECK(filled.filled == missing);
        CHECK(missingPairs(filled, present).empty());
        CHECK(filled.directions == whole.directions);
        for (std::size_t k = 0; k < filled.count(); ++k) {
            CHECK(valueOf(filled, grid, k, [](const LightAndView&) { return 1.0; }) ==
                  doctest::Approx(1).epsilon(1e-5));
        }
    }
}

TEST_CASE("a pair that is missing beside its twin at the pole takes the twin's value") {
    // The pole of a regular grid is listed once for each azimuth.
    const AngularGrid grid(regularDirections(2, 4));
    SampleSet set = chooseSamples(posterPlan({}), grid, SampleWish::kEverything);
    std::vector<std::uint8_t> present(grid.pairCount(), 1);
    present[grid.pairIndex(1, 2)] = 0;
    set = fillMissing(std::move(set), grid, present);
    double atPole = 0;
    for (const WeightedPair& source : set.sources[grid.pairIndex(1, 2)]) {
        CHECK(std::isfinite(source.weight));
        const LightAndView p = grid.pair(source.pair);
        if (p.light.theta == 0 && p.view.theta == 0) atPole += static_cast<double>(source.weight);
    }
    CHECK(atPole == doctest::Approx(1));
}

TEST_CASE("nothing missing changes nothing") {
    const AngularGrid grid(ubo81Directions());
    const SampleSet set = chooseSamples(posterPlan({}), grid, SampleWish::kMeasuredPairs);
    const std::vector<std::uint8_t> present(grid.pairCount(), 1);
    const SampleSet same = fillMissing(set, grid, present);
    CHECK(same.filled == 0);
    CHECK(same.pairs == set.pairs);
}

TEST_SUITE_END();
