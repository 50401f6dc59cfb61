// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/lobe_profile.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

using namespace abrdf;

namespace {

Atlas atlasOf(const std::function<double(const LightAndView&)>& value) {
    AtlasHeader header;
    header.grid = AngularGrid(ubo81Directions());
    header.layout = {AtlasKind::kAngular, 1, 1, 81, 81};
    std::vector<Rgb> pixels;
    for (const LightAndView& pair : pairsOf(header.grid)) {
        const auto grey = static_cast<float>(value(pair));
        pixels.push_back({grey, grey, grey});
    }
    return {header, pixels};
}

Radians halfAngle(const LightAndView& p) {
    return halfAngleOf(vectorFromDirection(p.light), vectorFromDirection(p.view));
}

/// A highlight of 6 degrees over a dark body.
double glossy(const LightAndView& p) {
    const double off = halfAngle(p) / radiansFromDegrees(6);
    return std::cos(p.light.theta) * (0.05 + 5 * std::exp(-off * off));
}

double ratioLookUp(const Atlas& atlas, const LobeProfile& lobe, const LightAndView& p) {
    const AngularGrid& grid = atlas.header().grid;
    double sum = 0;
    for (const WeightedPair& term : atlas.weights(p.light, p.view)) {
        sum += static_cast<double>(term.weight * atlas.pixels()[term.pair].g) /
               lobe.at(halfAngle(grid.pair(term.pair)));
    }
    return sum * lobe.at(halfAngle(p));
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("matt and black materials have no profile, so that they are interpolated as ever") {
    const LobeProfile matt(atlasOf([](const LightAndView& p) { return std::cos(p.light.theta); }));
    const LobeProfile black(atlasOf([](const LightAndView&) { return 0.0; }));
    for (const double degrees : {0.0, 3.0, 40.0, 90.0}) {
        CHECK(matt.at(radiansFromDegrees(degrees)) == 1);
        CHECK(black.at(radiansFromDegrees(degrees)) == 1);
    }
}

TEST_CASE("the profile of a glossy material falls with its highlight and never rises") {
    const LobeProfile lobe(atlasOf(glossy));
    double last = 1;
    for (double degrees = 0; degrees <= 90; degrees += 0.5) {
        const double p = lobe.at(radiansFromDegrees(degrees));
        CHECK(p > 0);
        CHECK(p <= last + 1e-12);
        last = p;
    }
    CHECK(lobe.at(radiansFromDegrees(15)) < 0.05);
    CHECK(lobe.at(radiansFromDegrees(60)) == doctest::Approx(0.05 / 5.05).epsilon(0.5));
}

TEST_CASE("as ratios values are exact at the nodes, and between them far nearer to the truth") {
    const Atlas atlas = atlasOf(glossy);
    const LobeProfile lobe(atlas);
    for (std::size_t i = 0; i < 6561; i += 97) {
        const LightAndView pair = atlas.header().grid.pair(i);
        CHECK(ratioLookUp(atlas, lobe, pair) ==
              doctest::Approx(static_cast<double>(atlas.pixels()[i].g)).epsilon(1e-5));
    }
    // Pairs about mirror positions: within 10 degrees of the half angle.
    double plain = 0;
    double ratio = 0;
    int count = 0;
    for (int k = 0; k < 4000; ++k) {
        const Direction light{radiansFromDegrees(std::fmod(0.613 * k, 70)),
                              std::fmod(0.71 * k, 6.28)};
        const Direction view{radiansFromDegrees(std::fmod(0.477 * k, 70)),
                             wrappedAzimuth(light.phi + kPi + 0.4 * std::sin(1.9 * k))};
        const LightAndView pair{light, view};
        if (halfAngle(pair) > radiansFromDegrees(10)) continue;
        const double truth = std::log(glossy(pair));
        plain +=
            std::abs(std::log(static_cast<double>(lookUp(atlas, light, view, 0, 0).g)) - truth);
        ratio += std::abs(std::log(ratioLookUp(atlas, lobe, pair)) - truth);
        ++count;
    }
    REQUIRE(count > 300);
    MESSAGE("mean error of ln B near the mirror: plain " << plain / count << ", as ratios "
                                                         << ratio / count);
    CHECK(ratio < 0.6 * plain);
}

TEST_SUITE_END();
