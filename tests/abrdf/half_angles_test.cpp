// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/half_angles.h"

#include "abrdf/merl_table.h"
#include "abrdf/random.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("half angles and pairs are inverses, whatever the sample's turn") {
    Random random(2);
    for (int k = 0; k < 500; ++k) {
        const LightAndView pair = {{random.uniform(0.01, 1.5), random.uniform(0, 6.28)},
                                   {random.uniform(0.01, 1.5), random.uniform(0, 6.28)}};
        const HalfAngles angles = halfAnglesFromPair(pair);
        const LightAndView back = pairFromHalfAngles(angles);
        CHECK(back.light.theta == doctest::Approx(pair.light.theta));
        CHECK(back.view.theta == doctest::Approx(pair.view.theta));
        CHECK(std::cos(back.light.phi - back.view.phi) ==
              doctest::Approx(std::cos(pair.light.phi - pair.view.phi)));
        CHECK(angles.thetaDifference == doctest::Approx(angleBetween(pair.light, pair.view) / 2));
        // The two ways of the light differ by half a turn.
        const HalfAngles swapped = halfAnglesFromPair({pair.view, pair.light});
        CHECK(swapped.thetaHalf == doctest::Approx(angles.thetaHalf));
        CHECK(std::cos(swapped.phiDifference - angles.phiDifference) == doctest::Approx(-1));
    }
}

TEST_CASE("a MERL table is continuous, and the same for both ways of the light") {
    std::vector<Rgb> brdf(merl::kEntries);
    for (std::size_t i = 0; i < brdf.size(); ++i) {
        const HalfAngles a = merl::anglesOfEntry(i);
        brdf[i] = {static_cast<float>(1 + a.thetaHalf + std::cos(2 * a.phiDifference)), 1, 1};
    }
    const MerlTable table(brdf);
    const auto brdfAt = [&](const LightAndView& p) {
        return static_cast<double>(table.evaluate(p).r) / (kPi * std::cos(p.light.theta));
    };
    Random random(4);
    for (int k = 0; k < 500; ++k) {
        const LightAndView pair = {{random.uniform(0, 1.2), random.uniform(0, 6.28)},
                                   {random.uniform(0, 1.2), random.uniform(0, 6.28)}};
        const HalfAngles a = halfAnglesFromPair(pair);
        CHECK(brdfAt(pair) ==
              doctest::Approx(1 + a.thetaHalf + std::cos(2 * a.phiDifference)).epsilon(1e-3));
        CHECK(brdfAt(pair) == doctest::Approx(brdfAt({pair.view, pair.light})).epsilon(1e-5));
    }
}

TEST_SUITE_END();
