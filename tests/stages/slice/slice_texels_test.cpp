// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/slice_texels.h"

#include "stages/slice/choose_samples.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace abrdf;

namespace {

const AngularGrid& ubo81() {
    static const AngularGrid kGrid(ubo81Directions());
    return kGrid;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("slices read hundreds of pairs, not thousands, and each sample's weights sum to 1") {
    const SampleSet set = chooseSamples(posterPlan({}), ubo81(), SampleWish::kSlices);
    CHECK(set.count() == 204);
    CHECK(set.pairs.size() < 500);
    CHECK(std::ranges::is_sorted(set.pairs));
    for (const auto& sources : set.sources) {
        float sum = 0;
        for (const WeightedPair& source : sources) {
            sum += source.weight;
            CHECK(std::ranges::binary_search(set.pairs, source.pair));
        }
        CHECK(sum == doctest::Approx(1));
    }
}

TEST_CASE("measured pairs are distinct, at their true directions, and no more than the plan's") {
    const SampleSet set = chooseSamples(posterPlan({}), ubo81(), SampleWish::kMeasuredPairs);
    CHECK(set.count() <= 204);
    CHECK(set.pairs.size() == set.count());
    for (std::size_t k = 0; k < set.count(); ++k) {
        CHECK(set.directions[k] == ubo81().pair(set.sources[k][0].pair));
    }
    CHECK(chooseSamples(posterPlan({}), ubo81(), SampleWish::kEverything).count() == 6561);
}

TEST_CASE("a missing pair is filled from its nearest, with weights that sum to 1, and counted") {
    SampleSet set = chooseSamples(posterPlan({}), ubo81(), SampleWish::kSlices);
    std::vector<std::uint8_t> present(ubo81().pairCount(), 1);
    const std::size_t gone = set.pairs[17];
    present[gone] = 0;
    CHECK(missingPairs(set, present) == std::vector<std::size_t>{gone});
    set = fillMissing(std::move(set), ubo81(), present);
    CHECK(set.filled == 1);
    CHECK_FALSE(std::ranges::binary_search(set.pairs, gone));
    for (const auto& sources : set.sources) {
        float sum = 0;
        for (const WeightedPair& source : sources) sum += source.weight;
        CHECK(sum == doctest::Approx(1));
    }
    const std::vector<std::uint8_t> nothing(ubo81().pairCount(), 0);
    CHECK_THROWS_AS(fillMissing(set, ubo81(), nothing), std::runtime_error);
}

TEST_CASE("image-major becomes texel-major, for any range of texels") {
    const SampleSet set = chooseSamples(posterPlan({}), ubo81(), SampleWish::kEverything);
    ImageStack stack(set.pairs, 7, 3);
    for (std::size_t i = 0; i < set.pairs.size(); ++i) {
        for (std::size_t t = 0; t < 21; ++t) {
            stack.image(i)[t] = {static_cast<float>(i), static_cast<float>(t), 1};
        }
    }
    const SlicedTexels sliced = sliceTexels(stack, set, 5, 9);
    REQUIRE(sliced.samples.texelCount() == 9);
    for (std::size_t t = 0; t < 9; ++t) {
        for (std::size_t k = 0; k < set.count(); k += 101) {
            CHECK(sliced.samples[t][k] == Rgb{static_cast<float>(k), static_cast<float>(5 + t), 1});
        }
    }
    CHECK(sliced.repaired == 0);
}

TEST_CASE("a sample without a value takes its neighbour's, and is counted") {
    const SampleSet set = chooseSamples(posterPlan({}), ubo81(), SampleWish::kMeasuredPairs);
    ImageStack stack(set.pairs, 2, 1);
    for (std::size_t i = 0; i < set.pairs.size(); ++i) {
        stack.image(i)[0] = {0.5F, 0.5F, 0.5F};
        stack.image(i)[1] = {std::nanf(""), 0, 0};
    }
    stack.image(9)[0] = {1, std::nanf(""), 1};
    const SlicedTexels sliced = sliceTexels(stack, set, 0, 2);
    CHECK(sliced.repaired == 1 + set.count());
    for (const Rgb& c : sliced.samples[0]) CHECK(c == Rgb{0.5F, 0.5F, 0.5F});
    for (const Rgb& c : sliced.samples[1]) CHECK(c == Rgb{});
}

TEST_SUITE_END();
