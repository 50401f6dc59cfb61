// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/greedy_slices.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/goniometer.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace abrdf;

namespace {

const AngularGrid& smallGrid() {
    static const AngularGrid kGrid(regularDirections(3, 5));
    return kGrid;
}

std::vector<Slice> someSlices() {
    SliceFamily family;
    family.elevations = {radiansFromDegrees(30), radiansFromDegrees(60)};
    family.offsets = 3;
    family.diagonalCounts = {5};
    return slicesOf(family);
}

GreedySlices chosen(std::size_t count) {
    return greedySlices(smallGrid(), someSlices(), {.count = count, .materials = 20, .free = true},
                        {});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("whole slices within the count, each once; a shorter plan is the beginning of a longer") {
    const GreedySlices longer = chosen(40);
    const GreedySlices shorter = chosen(9);
    REQUIRE(shorter.slices.size() == 2);
    std::size_t samples = 0;
    for (std::size_t i = 0; i < longer.slices.size(); ++i) {
        samples += static_cast<std::size_t>(longer.slices[i].count);
    }
    CHECK(samples <= 40);
    CHECK(samples > 35);
    CHECK(longer.deviation.size() == samples);
    CHECK(std::is_sorted(longer.deviation.rbegin(), longer.deviation.rend()));
    const auto isSame = [](const Slice& a, const Slice& b) { return samplesOf(a) == samplesOf(b); };
    CHECK(isSame(longer.slices[0], shorter.slices[0]));
    // Free samples of the same places can only be better, or nearly so: greedy is no optimum.
    CHECK(longer.freeDeviation.size() == 40);
    CHECK(longer.freeDeviation[samples - 1] < longer.deviation.back());
}

TEST_CASE("travel has its price: dear turns choose slices that travel less") {
    const auto travelOfAll = [](const GreedySlices& choice) {
        std::vector<std::vector<LightAndView>> slices;
        std::vector<LightAndView> all;
        for (const Slice& slice : choice.slices) {
            slices.push_back(samplesOf(slice));
            all.insert(all.end(), slices.back().begin(), slices.back().end());
        }
        std::vector<LightAndView> swept;
        for (const std::size_t i : sweptOrder(slices)) swept.push_back(all[i]);
        return travelOf(swept).sum() / static_cast<double>(swept.size());
    };
    const GreedySlices dear =
        greedySlices(smallGrid(), someSlices(), {.count = 20, .materials = 20, .travel = 1000}, {});
    CHECK(travelOfAll(dear) < 0.9 * travelOfAll(chosen(20)));
}

TEST_CASE("slices that no goniometer has are refused") {
    const auto of = [](std::vector<Radians> elevations, int count) {
        SliceFamily family;
        family.elevations = std::move(elevations);
        family.axialCounts = {count};
        return slicesOf(family).size();
    };
    CHECK(of({0.5}, 4) == 36);
    CHECK_THROWS_AS(of({}, 4), std::invalid_argument);
    CHECK_THROWS_AS(of({0}, 4), std::invalid_argument);
    CHECK_THROWS_AS(of({kPi / 2}, 4), std::invalid_argument);
    CHECK_THROWS_AS(of({std::nan("")}, 4), std::invalid_argument);
    CHECK_THROWS_AS(of({0.5, 0.5}, 4), std::invalid_argument);
    CHECK_THROWS_AS(of({0.5}, 0), std::invalid_argument);
    CHECK_THROWS_AS(chosen(3), std::invalid_argument);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("the same slices are chosen on 1 and 3 threads") {
    std::vector<double> first;
    for (const int threads : {1, 3}) {
        const ThreadLimit limit(threads);
        const GreedySlices choice = chosen(20);
        if (first.empty()) first = choice.deviation;
        CHECK(choice.deviation == first);
    }
}

TEST_SUITE_END();
