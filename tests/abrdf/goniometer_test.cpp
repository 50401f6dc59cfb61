// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/goniometer.h"

#include "abrdf/slice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

using namespace abrdf;

namespace {

LightAndView pairAt(double thetaLight, double phiLight, double thetaView, double phiView) {
    return {{radiansFromDegrees(thetaLight), radiansFromDegrees(phiLight)},
            {radiansFromDegrees(thetaView), radiansFromDegrees(phiView)}};
}

void checkTravel(const Travel& travel, double light, double sensor, double sample) {
    CHECK(degreesFromRadians(travel.light) == doctest::Approx(light));
    CHECK(degreesFromRadians(travel.sensor) == doctest::Approx(sensor));
    CHECK(degreesFromRadians(travel.sample) == doctest::Approx(sample));
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("along an axial slice the sample turns alone, along a diagonal light and sensor") {
    const Slice axial{SliceKind::kAxial, 0.5, 1.0, 0.7, 24, 0, 1};
    checkTravel(travelOf(samplesOf(axial)), 0, 0, 345);
    std::vector<LightAndView> diagonal;
    for (int k = 0; k < 9; ++k) diagonal.push_back(pairAt(30, 320 - 10 * k, 45, 10 * k));
    checkTravel(travelOf(diagonal), 80, 80, 0);
}

TEST_CASE("elevations add, azimuths go the shorter way, and the pole has any azimuth") {
    checkTravel(travelOf(std::vector{pairAt(30, 350, 45, 0), pairAt(60, 10, 30, 0)}), 50, 15, 0);
    checkTravel(travelOf(std::vector{pairAt(30, 0, 45, 0), pairAt(0, 222, 45, 0)}), 30, 0, 0);
    checkTravel(travelOf(std::vector{pairAt(0, 0, 0, 0), pairAt(0, 90, 0, 200)}), 0, 0, 0);
    checkTravel(travelOf({}), 0, 0, 0);
}

TEST_CASE("no order of axes does better than the median: against a search over turns") {
    for (double a = -180; a < 180; a += 36) {
        for (double b = -180; b < 180; b += 45) {
            const Radians found =
                travelOf(std::vector{pairAt(30, 0, 45, 0), pairAt(30, a, 45, b)}).sum();
            double least = 1e9;
            const auto turn = [](double degrees) { return std::abs(std::remainder(degrees, 360)); };
            for (int p = -180; p < 180; ++p) {
                least = std::min(least, turn(a + p) + turn(b + p) + turn(p));
            }
            CHECK(degreesFromRadians(found) == doctest::Approx(least).epsilon(1e-9));
        }
    }
}

TEST_CASE("a swept order holds every sample once, slice by slice, and travels less") {
    std::vector<std::vector<LightAndView>> slices;
    for (const double theta : {15.0, 75.0, 30.0, 60.0}) {
        for (const SliceKind kind : {SliceKind::kDiagonal, SliceKind::kAxial}) {
            slices.push_back(samplesOf({kind, radiansFromDegrees(theta), 0.8, theta, 9, 0, 1.5}));
        }
    }
    const std::vector<std::size_t> order = sweptOrder(slices);
    std::vector<LightAndView> all;
    for (const auto& slice : slices) all.insert(all.end(), slice.begin(), slice.end());
    std::vector<std::size_t> sorted = order;
    std::ranges::sort(sorted);
    std::vector<std::size_t> each(all.size());
    std::iota(each.begin(), each.end(), std::size_t{0});
    REQUIRE(sorted == each);
    std::vector<LightAndView> swept;
    for (std::size_t i = 0; i < order.size(); ++i) {
        swept.push_back(all[order[i]]);
        CHECK(order[i] / 9 == order[i / 9 * 9] / 9);
    }
    CHECK(travelOf(swept).sum() < 0.8 * travelOf(all).sum());
}

TEST_SUITE_END();
