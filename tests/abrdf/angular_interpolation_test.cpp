// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/angular_interpolation.h"

#include "abrdf/angular_grid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace abrdf;

namespace {

std::map<std::size_t, double> weightOf(const DirectionWeights& weights) {
    std::map<std::size_t, double> sums;
    for (const auto& term : weights.terms) sums[term.index] += term.weight;
    return sums;
}

/// Largest change of any direction's weight.
double difference(const DirectionWeights& a, const DirectionWeights& b) {
    std::map<std::size_t, double> change = weightOf(a);
    for (const auto& [index, weight] : weightOf(b)) change[index] -= weight;
    double largest = 0;
    for (const auto& [index, weight] : change) largest = std::max(largest, std::abs(weight));
    return largest;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a small step of the target is a small step of the weights") {
    // Nodes are taken as such within 0.02 degrees: at most 0.02 / 5 of a weight.
    constexpr double kStep = 1e-6;
    for (const auto& directions : {ubo81Directions(), dome151Directions()}) {
        const AngularInterpolation interpolation(directions);
        for (int k = 0; k < 4000; ++k) {
            const Direction d = {radiansFromDegrees(0.02 * k), radiansFromDegrees(1.7 * k)};
            const DirectionWeights here = interpolation.weights(d);
            CHECK(difference(here, interpolation.weights({d.theta + kStep, d.phi})) < 0.006);
            CHECK(difference(here, interpolation.weights({d.theta, d.phi + kStep})) < 0.006);
        }
    }
}

TEST_CASE("at the pole every azimuth is the pole") {
    const AngularInterpolation interpolation(ubo81Directions());
    for (int k = 0; k < 24; ++k) {
        const DirectionWeights w = interpolation.weights({0, 0.3 * k});
        CHECK(weightOf(w) == std::map<std::size_t, double>{{0, 1.0}});
    }
}

TEST_CASE("past the last ring the ring's value is held, and said to be") {
    const AngularInterpolation interpolation(ubo81Directions());
    for (int k = 0; k < 50; ++k) {
        const Radians phi = 0.13 * k;
        const DirectionWeights edge = interpolation.weights({radiansFromDegrees(75), phi});
        const DirectionWeights past = interpolation.weights({radiansFromDegrees(89), phi});
        CHECK(difference(edge, past) == 0);
        CHECK_FALSE(edge.extrapolated);
        CHECK(past.extrapolated);
    }
}

TEST_CASE("a ring that does not begin at azimuth 0 closes on itself") {
    // dome151's second ring: 15, 75 .. 315 degrees, indices 1 .. 6.
    const AngularInterpolation interpolation(dome151Directions());
    const auto weights = weightOf(interpolation.weights({radiansFromDegrees(11), 0}));
    REQUIRE(weights.size() == 2);
    CHECK(weights.at(1) == doctest::Approx(0.75));
    CHECK(weights.at(6) == doctest::Approx(0.25));
}

TEST_CASE("directions rounded as file names round them are still on their ring") {
    std::vector<Direction> rounded = regularDirections(4, 16);
    for (std::size_t i = 0; i < rounded.size(); ++i) {
        rounded[i].theta += i % 3 == 0 ? 1e-4 : 0.0;
        rounded[i].phi += i % 2 == 0 ? 1e-4 : -1e-4;
    }
    const AngularInterpolation interpolation(rounded);
    for (std::size_t i = 16; i < rounded.size(); ++i) {
        const DirectionWeights w = interpolation.weights(regularDirections(4, 16)[i]);
        CHECK(weightOf(w) == std::map<std::size_t, double>{{i, 1.0}});
    }
}

TEST_CASE("a list of one direction is that direction everywhere") {
    const AngularInterpolation interpolation({{0.5, 1}});
    for (const Direction target : {Direction{0, 0}, {0.5, 4}, {1.5, 1}}) {
        const auto weights = weightOf(interpolation.weights(target));
        REQUIRE(weights.size() == 1);
        CHECK(weights.at(0) == doctest::Approx(1));
    }
}

TEST_SUITE_END();
