// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/display_difference.h"

#include "color/delta_e.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("L*a*b* in floats is that in doubles within 1e-3") {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> light(0, 1);
    for (int i = 0; i < 2000; ++i) {
        const float scale = std::pow(10.0F, -3 * light(random));
        const Rgb color = scale * Rgb{light(random), light(random), light(random)};
        DisplayLab fast{};
        displayLabs(&color, 1, 1, &fast);
        const Lab slow = labFromLinearRec709(color);
        CHECK(std::abs(static_cast<double>(fast.L) - slow.L) < 1e-3);
        CHECK(std::abs(static_cast<double>(fast.a) - slow.a) < 1e-3);
        CHECK(std::abs(static_cast<double>(fast.b) - slow.b) < 1e-3);
    }
}

TEST_SUITE_END();
