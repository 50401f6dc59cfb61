// SPDX-License-Identifier: BSD-3-Clause
#include "color/heat_color.h"

#include "color/delta_e.h"

#include <doctest/doctest.h>

#include <limits>

namespace abrdf {

namespace {

double lightness(Srgb8 color) {
    const auto linear = [](std::uint8_t code) {
        return static_cast<float>(linearFromSrgb(code / 255.0));
    };
    return labFromLinearRec709({linear(color[0]), linear(color[1]), linear(color[2])}).L;
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("the colours of the map grow evenly lighter") {
        for (int step = 0; step < 16; ++step) {
            const double growth =
                lightness(heatColor((step + 1) / 16.0)) - lightness(heatColor(step / 16.0));
            CHECK(growth > 3.5);
            CHECK(growth < 9);
        }
        CHECK(lightness(heatColor(0)) < 8);
        CHECK(lightness(heatColor(1)) > 90);
    }

    TEST_CASE("what lies outside the map has its last colours, and NaN is grey") {
        CHECK(heatColor(-3) == heatColor(0));
        CHECK(heatColor(1e9) == heatColor(1));
        CHECK(heatColor(std::numeric_limits<double>::quiet_NaN()) == Srgb8{128, 128, 128});
    }
}

}  // namespace abrdf
