// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/tabulated_warp.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

namespace {
constexpr TableBlend kFirst = {{0, 0, 0, 0}, {1, 0, 0, 0}};
}

TEST_SUITE_BEGIN("unit");

TEST_CASE("tables are bilinear between their nodes, and blended") {
    const TableStack stack(3, 2, {0, 1, 2, 10, 11, 12, 5, 5, 5, 5, 5, 5});
    CHECK(stack.count() == 2);
    CHECK(stack.at({0.25, 0.5}, kFirst) == doctest::Approx(5.5));
    CHECK(stack.at({1, 1}, kFirst) == doctest::Approx(12));
    CHECK(stack.at({0, 0}, {{0, 1, 0, 0}, {0.25, 0.75, 0, 0}}) == doctest::Approx(3.75));
}

TEST_CASE("the inverse warp is the integral of the density: columns first, then rows") {
    // A density that is x + y up to a factor: marginal and conditional integrals are polynomials.
    const TabulatedWarp warp(TableStack(2, 2, {0, 1, 1, 2}));
    for (const double x : {0.0, 0.3, 1.0}) {
        for (const double y : {0.0, 0.6, 1.0}) {
            const SquarePlace place = warp.invert({x, y}, kFirst);
            CHECK(place.x == doctest::Approx((x * x / 2 + x * y) / (0.5 + y)));
            CHECK(place.y == doctest::Approx(y / 2 + y * y / 2));
        }
    }
    const TabulatedWarp uniform(TableStack(3, 4, std::vector<float>(12, 7)));
    CHECK(uniform.invert({0.37, 0.81}, kFirst).x == doctest::Approx(0.37));
    CHECK(uniform.invert({0.37, 0.81}, kFirst).y == doctest::Approx(0.81));
    const TabulatedWarp empty(TableStack(2, 2, {0, 0, 0, 0}));
    CHECK(std::isfinite(empty.invert({0.5, 0.5}, kFirst).x));
}

TEST_CASE("warp and inverse undo each other, and the density is the image's share of the square") {
    const TabulatedWarp warp(TableStack(3, 3, {0, 1, 2, 0.5, 4, 0, 3, 1, 2}));
    for (const double x : {0.01, 0.3, 0.77, 1.0}) {
        for (const double y : {0.0, 0.2, 0.6, 0.99}) {
            const SquarePlace there = warp.warp({x, y}, 0);
            const SquarePlace back = warp.invert(there, kFirst);
            CHECK(back.x == doctest::Approx(x).epsilon(1e-5));
            CHECK(back.y == doctest::Approx(y).epsilon(1e-5));
        }
    }
    double sum = 0;
    for (int i = 0; i < 400; ++i) {
        sum += warp.density({(i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20}, kFirst) / 400;
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-6));
}

TEST_SUITE_END();
