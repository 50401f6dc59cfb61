// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/pair_interpolation.h"

#include "abrdf/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace abrdf;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using Material = std::function<double(const LightAndView&)>;

std::vector<Rgb> sampled(const AngularGrid& grid, const Material& material) {
    std::vector<Rgb> values;
    for (const LightAndView& pair : pairsOf(grid)) {
        const auto v = static_cast<float>(material(pair));
        values.push_back({v, 2 * v, 0});
    }
    return values;
}

LightAndView randomPair(Random& random, double maxTheta) {
    const auto direction = [&] {
        return Direction{std::acos(random.uniform(std::cos(radiansFromDegrees(maxTheta)), 1)),
                         random.uniform(-7, 14)};
    };
    return {direction(), direction()};
}

/// Largest relative error over many pairs within 75 degrees.
double worstError(const AngularGrid& grid, const Material& material) {
    const PairInterpolation interpolation(grid);
    const std::vector<Rgb> values = sampled(grid, material);
    Random random(3);
    double worst = 0;
    for (int k = 0; k < 3000; ++k) {
        const LightAndView target = randomPair(random, 75);
        const double value = static_cast<double>(interpolation.value(target, values).r);
        worst = std::max(worst, std::abs(value / material(target) - 1));
    }
    return worst;
}

const std::vector<AngularGrid>& grids() {
    static const std::vector<AngularGrid> kGrids = {
        AngularGrid(ubo81Directions()), AngularGrid(dome151Directions(), ubo81Directions()),
        AngularGrid(regularDirections(6, 48))};
    return kGrids;
}

/// An isotropic highlight, a few degrees wide.
double highlight(const LightAndView& pair) {
    const Imath::V3d sum = vectorFromDirection(pair.light) + vectorFromDirection(pair.view);
    return 0.05 + std::exp(-(1 - sum.normalized().z) * 1000);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("interpolation is exact at every pair of the grid, to the bit") {
    Random random(1);
    for (const AngularGrid& grid : grids()) {
        std::vector<Rgb> values;
        for (std::size_t i = 0; i < grid.pairCount(); ++i) {
            values.push_back({static_cast<float>(random.uniform()), 0, 1});
        }
        const PairInterpolation interpolation(grid);
        for (std::size_t i = 0; i < grid.pairCount(); i += 17) {
            LightAndView pair = grid.pair(i);
            if (pair.light.theta == 0 || pair.view.theta == 0) continue;  // Listed often.
            pair.light.phi += 4 * kPi;
            pair.view.phi -= 2 * kPi;
            CHECK(interpolation.value(pair, values) == values[i]);
        }
    }
}

TEST_CASE("constants and low spherical harmonics are reproduced") {
    for (const AngularGrid& grid : grids()) {
        CHECK(worstError(grid, [](const LightAndView&) { return 0.7; }) < 1e-6);
        CHECK(worstError(grid, [](const LightAndView& p) { return std::cos(p.light.theta); }) <
              2e-3);
        const auto x = [](Direction d) { return vectorFromDirection(d).x; };
        const auto y = [](Direction d) { return vectorFromDirection(d).y; };
        const auto z = [](Direction d) { return vectorFromDirection(d).z; };
        CHECK(worstError(grid, [&](const LightAndView& p) {
                  return 2 + x(p.light) - 0.5 * y(p.light) + 0.3 * z(p.view) * y(p.view);
              }) < 0.01);
        CHECK(worstError(grid, [&](const LightAndView& p) {
                  return 2 + x(p.light) * x(p.view) + y(p.light) * y(p.view) +
                         x(p.light) * y(p.light);
              }) < 0.015);
    }
}

TEST_CASE("the linear weights are above 0, sum to 1, and are few") {
    Random random(7);
    for (const AngularGrid& grid : grids()) {
        const PairInterpolation interpolation(grid);
        for (int k = 0; k < 500; ++k) {
            const auto weights = interpolation.weights(randomPair(random, 90));
            double sum = 0;
            for (const WeightedPair& term : weights) {
                CHECK(term.pair < grid.pairCount());
                CHECK(term.weight > 0);
                sum += static_cast<double>(term.weight);
            }
            CHECK(sum == doctest::Approx(1).epsilon(1e-6));
            CHECK(weights.size() <= 16);
        }
    }
}

TEST_CASE(
    "a highlight is found between the rings' azimuths, where light by light it would be lost") {
    const AngularGrid grid(ubo81Directions());
    const PairInterpolation interpolation(grid);
    const AngularInterpolation ring(ubo81Directions());
    const std::vector<Rgb> values = sampled(grid, highlight);
    for (int k = 0; k < 18; ++k) {
        const Radians phi = radiansFromDegrees(20.0 * k + 10);
        const Radians theta = radiansFromDegrees(45);
        const LightAndView mirror = {{theta, phi}, {theta, phi + kPi}};
        double separate = 0;
        for (const auto& l : ring.weights(mirror.light).terms) {
            for (const auto& v : ring.weights(mirror.view).terms) {
                separate += l.weight * v.weight *
                            static_cast<double>(values[grid.pairIndex(l.index, v.index)].r);
            }
        }
        CHECK(interpolation.value(mirror, values).r == doctest::Approx(1.05).epsilon(0.02));
        CHECK(separate < 0.9);
    }
}

TEST_CASE("values have no step: at the pole, at azimuth 0, at rings, anywhere") {
    constexpr double kStep = 1e-5;
    for (const AngularGrid& grid : grids()) {
        const PairInterpolation interpolation(grid);
        const std::vector<Rgb> values = sampled(grid, [](const LightAndView& p) {
            return 1 + highlight(p) +
                   std::cos(p.light.phi - 3 * p.view.phi) / 4 * std::sin(p.light.theta) *
                       std::sin(p.view.theta);
        });
        const auto at = [&](LightAndView p) { return interpolation.value(p, values).r; };
        Random random(5);
        for (int k = 0; k < 500; ++k) {
            const LightAndView p = randomPair(random, 75);
            // Nodes are taken as such within 0.02 degrees.
            for (const double theta : {0.0, p.light.theta, radiansFromDegrees(30)}) {
                const LightAndView here = {{theta, p.light.phi}, p.view};
                CHECK(at(here) ==
                      doctest::Approx(at({{theta + kStep, p.light.phi}, p.view})).epsilon(0.01));
                CHECK(at(here) ==
                      doctest::Approx(at({{theta, p.light.phi + kStep}, p.view})).epsilon(0.01));
            }
            CHECK(at({{0, 0}, p.view}) ==
                  doctest::Approx(at({{0, p.light.phi}, p.view})).epsilon(1e-5));
        }
    }
}

TEST_CASE("past the last elevation the value is held, and said to be extrapolated") {
    const AngularGrid grid(ubo81Directions());
    const PairInterpolation interpolation(grid);
    const std::vector<Rgb> values = sampled(grid, highlight);
    const Direction view = {0.4, 2};
    const auto edge = interpolation.lightPlace({radiansFromDegrees(75), 0.3});
    const auto past = interpolation.lightPlace({radiansFromDegrees(88), 0.3});
    const auto v = interpolation.viewPlace(view);
    CHECK(interpolation.value(edge, v, values) == interpolation.value(past, v, values));
    CHECK_FALSE(PairInterpolation::isExtrapolated(edge, v));
    CHECK(PairInterpolation::isExtrapolated(past, v));
}

TEST_CASE("lists without rings, or without a pole, are interpolated without a step too") {
    std::vector<Direction> scattered;
    for (int i = 0; i < 60; ++i) scattered.push_back({0.021 * i, 2.4 * i});
    std::vector<Direction> noPole = ubo81Directions();
    noPole.erase(noPole.begin());
    for (const auto& list : {scattered, noPole}) {
        const AngularGrid grid(list);
        const PairInterpolation interpolation(grid);
        const auto values = sampled(grid, [](const LightAndView& p) {
            return 2 + std::sin(p.light.theta) * std::cos(p.light.phi);
        });
        Random random(9);
        for (int k = 0; k < 200; ++k) {
            const LightAndView p = randomPair(random, 70);
            const float here = interpolation.value(p, values).r;
            const LightAndView beside = {{p.light.theta + 1e-6, p.light.phi}, p.view};
            CHECK(here == doctest::Approx(interpolation.value(beside, values).r).epsilon(0.005));
        }
        CHECK(interpolation.value({{0, 0}, {0.3, 1}}, values).r ==
              doctest::Approx(interpolation.value({{0, 3}, {0.3, 1}}, values).r));
        CHECK(interpolation.value(grid.pair(70), values) == values[70]);
    }
}

TEST_CASE("values at another grid depend on the pairs that it is said to need, and on no others") {
    const AngularGrid grid(ubo81Directions());
    const PairInterpolation interpolation(grid);
    const AngularGrid targets({{radiansFromDegrees(30), 0}, {0.5, 0.4}}, {{0.7, 2}, {0, 0}});
    const std::vector<std::size_t> needed = interpolation.pairsFor(targets);
    CHECK(needed.size() < grid.pairCount() / 20);
    const std::vector<Rgb> all = sampled(grid, highlight);
    std::vector<Rgb> some(all.size(), Rgb{kNan, kNan, kNan});
    for (const std::size_t pair : needed) some[pair] = all[pair];
    for (const LightAndView& pair : pairsOf(targets)) {
        CHECK(interpolation.value(pair, some) == interpolation.value(pair, all));
    }
    // At a pair of the grid it alone is needed.
    const AngularGrid one({grid.lights()[7]}, {grid.views()[9]});
    CHECK(interpolation.pairsFor(one) == std::vector<std::size_t>{grid.pairIndex(7, 9)});
    CHECK(interpolation.pairsFor(grid).size() == grid.pairCount());
}

TEST_SUITE_END();
