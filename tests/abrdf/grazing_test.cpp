// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/grazing.h"

#include "abrdf/grazing_brdf.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

namespace {

constexpr Radians kMax = radiansFromDegrees(75);

/// cos(theta_i) (1 + theta_v): a BRDF that is linear in theta_v.
Rgb material(const LightAndView& p) {
    const auto v = static_cast<float>(std::cos(p.light.theta) * (1 + p.view.theta));
    return {v, v, 1};
}

struct Material : BrdfTable {
    Rgb evaluate(const LightAndView& pair) const override { return material(pair); }
};

std::vector<Rgb> outerValues(const GrazingMap& map) {
    AbrdfTile inner(2, map.inner().pairCount());
    for (std::size_t i = 0; i < map.inner().pairCount(); ++i) {
        CHECK(map.inner().pair(i).light.theta <= kMax + 1e-9);
        inner[1][i] = material(map.inner().pair(i));
    }
    const AbrdfTile outer = map.apply(inner);
    return {outer[1].begin(), outer[1].end()};
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a grid within the measured elevations is left alone") {
    const AngularGrid grid(ubo81Directions());
    const GrazingMap map(grid, kMax, Grazing::kHold, Cosine::kKept);
    CHECK(map.isIdentity());
    CHECK(map.inner() == grid);
    CHECK(map.extrapolatedPairs() == 0);
}

TEST_CASE("past them hold keeps the BRDF, fade takes it to 0, extrapolate goes on") {
    std::vector<Direction> directions = {{0, 0}, {kMax, 1}};
    for (const double degrees : {80.0, 89.9})
        directions.push_back({radiansFromDegrees(degrees), 1});
    const AngularGrid outer(directions);
    for (const auto policy : {Grazing::kHold, Grazing::kFade, Grazing::kExtrapolate}) {
        CAPTURE(nameOf(policy));
        const GrazingMap map(outer, kMax, policy, Cosine::kKept);
        CHECK(map.extrapolatedPairs() == 12);
        const std::vector<Rgb> values = outerValues(map);
        const Material brdf;
        const GrazingBrdf anywhere(brdf, kMax, policy, Cosine::kKept);
        for (std::size_t i = 0; i < outer.pairCount(); ++i) {
            const LightAndView pair = outer.pair(i);
            CHECK(values[i].r == doctest::Approx(anywhere.evaluate(pair).r));
            const double held = std::cos(pair.light.theta) * (1 + std::min(kMax, pair.view.theta));
            if (policy == Grazing::kHold) CHECK(values[i].r == doctest::Approx(held));
            if (policy == Grazing::kExtrapolate) {
                CHECK(values[i].r == doctest::Approx(material(pair).r));
            }
            if (policy == Grazing::kFade && !anywhere.isExtrapolated(pair)) {
                CHECK(values[i].r == material(pair).r);
            }
        }
        if (policy == Grazing::kFade) {
            CHECK(values[2].r <
                  outerValues(GrazingMap(outer, kMax, Grazing::kHold, Cosine::kKept))[2].r);
            CHECK(values[3].r < 1e-3);
        }
    }
}

TEST_CASE("where the cosine is not in the values, they are held as they are") {
    const std::vector<Direction> directions = {{0, 0}, {radiansFromDegrees(85), 1}};
    const GrazingMap map(AngularGrid(directions), kMax, Grazing::kHold, Cosine::kDivided);
    const std::vector<Rgb> values = outerValues(map);
    CHECK(values[2].r == material({{kMax, 1}, {0, 0}}).r);
}

TEST_CASE("weights of the outer grid reach the pairs that it is made of") {
    const Direction past = {radiansFromDegrees(85), 1};
    const AngularGrid outer({{0.2, 0}, past}, {{0.3, 0}, past});
    const std::vector<double> weights = {0.1, 0.2, 0.3, 0.4};
    const GrazingMap map(outer, kMax, Grazing::kFade, Cosine::kKept);
    const std::vector<double> inner = map.innerWeights(weights);
    REQUIRE(inner.size() == map.inner().pairCount());
    // The adjoint of apply().
    std::vector<Rgb> values(inner.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i].r = static_cast<float>(i + 1);
    std::vector<Rgb> made(weights.size());
    map.apply(values, made);
    double ofInner = 0;
    double ofOuter = 0;
    for (std::size_t i = 0; i < inner.size(); ++i) {
        ofInner += inner[i] * static_cast<double>(values[i].r);
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
        ofOuter += weights[i] * static_cast<double>(made[i].r);
    }
    CHECK(ofInner == doctest::Approx(ofOuter));
    const GrazingMap same(AngularGrid({{0.2, 0}}, {{0.3, 0}}), kMax, Grazing::kHold, Cosine::kKept);
    CHECK(same.innerWeights(std::vector<double>{1}) == std::vector<double>{1});
}

TEST_CASE("names of the policies are understood, and no others") {
    for (const char* name : {"hold", "fade", "extrapolate"}) {
        CHECK(nameOf(grazingFromName(name)) == name);
    }
    CHECK_THROWS_AS(grazingFromName("none"), std::invalid_argument);
}

TEST_SUITE_END();
