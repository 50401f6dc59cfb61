// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/slice_plan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace abrdf;

namespace {

/// Distance of two azimuths on the circle.
double azimuthGap(Radians a, Radians b) {
    const Radians gap = wrappedAzimuth(a - b);
    return std::min(gap, 2 * kPi - gap);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the poster's plan has 204 samples, each on its slice") {
    const SlicePlan plan;
    const std::vector<LightAndView> samples = plan.samples();
    REQUIRE(samples.size() == 204);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t s = i / 51;
        CHECK(samples[i].light.theta == plan.thetaLight(s));
        CHECK(samples[i].view.theta == plan.thetaView(s));
        const Radians phiLight = samples[i].light.phi;
        const Radians phiView = samples[i].view.phi;
        if (i % 51 < 24) {
            CHECK(azimuthGap(phiView, phiLight + plan.alpha) < 1e-9);
        } else {
            CHECK(azimuthGap(phiLight, plan.alpha - phiView) < 1e-9);
        }
    }
}

TEST_CASE("poster:N never has more than N samples, and poster:204 is the poster's") {
    for (const int n : {8, 16, 28, 52, 100, 204, 408}) {
        const SlicePlan plan = slicePlanFromName("poster:" + std::to_string(n));
        CHECK(plan.samples().size() <= static_cast<std::size_t>(n));
        CHECK(plan.samples().size() + 4 > static_cast<std::size_t>(n));
    }
    CHECK(slicePlanFromName("poster:204").samples() == slicePlanFromName("poster").samples());
}

TEST_CASE("impossible plans are refused") {
    CHECK_THROWS_AS(slicePlanFromName("poster:7"), std::invalid_argument);
    CHECK_THROWS_AS(slicePlanFromName("poster:many"), std::invalid_argument);
    CHECK_THROWS_AS(slicePlanFromName("bespoke"), std::invalid_argument);
    SlicePlan plan;
    plan.elevations = {0.5, 0.5};
    CHECK_THROWS_AS(checkPlan(plan), std::invalid_argument);
    plan = {};
    plan.axialCount = 0;
    CHECK_THROWS_AS(checkPlan(plan), std::invalid_argument);
    plan = {};
    plan.alpha = std::nan("");
    CHECK_THROWS_AS(checkPlan(plan), std::invalid_argument);
}

TEST_SUITE_END();
