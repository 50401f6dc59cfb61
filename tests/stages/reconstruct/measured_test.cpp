// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "abrdf/pair_interpolation.h"
#include "stages/reconstruct/reconstructor.h"
#include "stages/slice/choose_samples.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace abrdf;

namespace {

/// values: of all pairs of the input, of which the samples are.
std::vector<Rgb> measured(const AngularGrid& input, const AngularGrid& output,
                          const SampleSet& samples, const std::vector<Rgb>& values) {
    const auto reconstructor =
        methodFromName("measured").make({SlicePlan(), samples, input, output});
    std::vector<Rgb> own;
    for (const std::size_t pair : samples.pairs) own.push_back(values[pair]);
    std::vector<Rgb> abrdf(output.pairCount());
    reconstructor->reconstruct(own, abrdf);
    return abrdf;
}

std::vector<Rgb> measured(const AngularGrid& input, const AngularGrid& output,
                          const std::vector<Rgb>& values) {
    return measured(input, output, chooseSamples({}, input, SampleWish::kEverything), values);
}

Rgb materialAt(const LightAndView& p) {
    const double value = 1 + std::cos(p.light.theta) * std::cos(p.light.phi - 2 * p.view.phi);
    return {static_cast<float>(value), static_cast<float>(p.view.theta),
            static_cast<float>(p.light.phi)};
}

std::vector<Rgb> materialOn(const AngularGrid& grid) {
    std::vector<Rgb> values;
    for (std::size_t i = 0; i < grid.pairCount(); ++i) values.push_back(materialAt(grid.pair(i)));
    return values;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("measured on its own grid is what was measured, bit by bit") {
    const AngularGrid grid(ubo81Directions(), regularDirections(3, 4));
    CHECK(measured(grid, grid, materialOn(grid)) == materialOn(grid));
}

TEST_CASE("measured on a part of its grid is exact there") {
    const AngularGrid grid(dome151Directions());
    std::vector<Direction> some;
    for (std::size_t i = 0; i < 151; i += 10) some.push_back(dome151Directions()[i]);
    const AngularGrid part(some);
    const std::vector<Rgb> abrdf = measured(grid, part, materialOn(grid));
    for (std::size_t i = 0; i < part.pairCount(); ++i) {
        CHECK(abrdf[i].r == doctest::Approx(materialAt(part.pair(i)).r).epsilon(1e-5));
    }
}

TEST_CASE("from the pairs that another grid needs it makes what it makes of all") {
    const AngularGrid grid(ubo81Directions());
    const AngularGrid other({{0.5, 1}, {0.9, 4}}, {{0.3, 2}, {0, 0}, {1.1, 5}});
    const SampleSet some = samplesOfPairs(grid, PairInterpolation(grid).pairsFor(other));
    CHECK(some.count() < 1000);
    CHECK(measured(grid, other, some, materialOn(grid)) == measured(grid, other, materialOn(grid)));
}

TEST_CASE("measured on any grid keeps constants, and a smooth material to half a percent") {
    const AngularGrid grid(ubo81Directions());
    const AngularGrid other(regularDirections(7, 11), dome151Directions());
    for (const Rgb& c : measured(grid, other, std::vector<Rgb>(6561, Rgb{0.25F, 3, 0}))) {
        CHECK(c.r == doctest::Approx(0.25));
        CHECK(c.g == doctest::Approx(3));
        CHECK(c.b == 0);
    }
    const auto smooth = [](const LightAndView& p) {
        return std::cos(p.light.theta) *
               (1 + 0.3 * std::sin(p.light.theta) * std::cos(p.light.phi) +
                0.2 * std::sin(p.view.theta) * std::sin(p.view.phi - 0.4));
    };
    std::vector<Rgb> values;
    for (const LightAndView& p : pairsOf(grid)) {
        values.push_back({static_cast<float>(smooth(p)), 1, 1});
    }
    const std::vector<Rgb> abrdf = measured(grid, other, values);
    for (std::size_t i = 0; i < other.pairCount(); ++i) {
        CHECK(abrdf[i].r == doctest::Approx(smooth(other.pair(i))).epsilon(0.005));
    }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("threads");

TEST_CASE("every method gives the same bits on 1, 2 and 7 threads") {
    const AngularGrid grid(regularDirections(6, 8));
    for (const Method& method : methods()) {
        CAPTURE(method.name);
        if (method.wish == SampleWish::kMeasuredPairs) continue;
        const SlicePlan plan;
        const std::size_t count =
            method.wish == SampleWish::kSlices ? plan.samples().size() : grid.pairCount();
        AbrdfTile samples(21, count);
        for (std::size_t i = 0; i < samples.values().size(); ++i) {
            const auto v = static_cast<float>(std::abs(std::sin(0.37 * static_cast<double>(i))));
            samples.values()[i] = {v, v * v, 1 - v};
        }
        const auto reconstructor = method.make({plan, {}, grid, grid});
        std::vector<Rgb> first;
        std::uint64_t firstClamped = 0;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            const ReconstructedTexels texels = reconstructTexels(samples, grid, *reconstructor);
            const auto values = texels.abrdfs.values();
            if (first.empty()) {
                first.assign(values.begin(), values.end());
                firstClamped = texels.unreal.clamped;
            }
            CHECK(std::ranges::equal(values, first));
            CHECK(texels.unreal.clamped == firstClamped);
        }
    }
}

TEST_SUITE_END();
