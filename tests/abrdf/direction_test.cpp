// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/direction.h"

#include "abrdf/random.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("theta opens from the normal, phi turns from +x to +y") {
    const auto check = [](Direction d, const Imath::V3d& expected) {
        CHECK((vectorFromDirection(d) - expected).length() < 1e-15);
    };
    check({0, 0}, {0, 0, 1});
    check({kPi / 2, 0}, {1, 0, 0});
    check({kPi / 2, kPi / 2}, {0, 1, 0});
    check({kPi / 2, kPi}, {-1, 0, 0});
    check({kPi / 2, 1.5 * kPi}, {0, -1, 0});
}

TEST_CASE("a vector comes back from its direction, of unit length, over the whole sphere") {
    Random random(1);
    for (int k = 0; k < 1000; ++k) {
        const Imath::V3d v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (v.length() < 1e-3) continue;
        const Direction d = directionFromVector(v);
        CHECK((d.phi >= 0 && d.phi < 2 * kPi));
        CHECK((vectorFromDirection(d) - v.normalized()).length() < 1e-14);
    }
    CHECK(directionFromVector({0, 0, 3}) == Direction{0, 0});
}

TEST_CASE("a wrapped azimuth is the same angle in 0 .. 2 pi, and 2 pi is never reached") {
    for (const double angle : {0.0, -0.0, 1e-300, -1e-300, -1e-17, 2 * kPi, -2 * kPi, 1e6, -1e6,
                               std::nextafter(2 * kPi, 7.0), std::nextafter(2 * kPi, 0.0)}) {
        CAPTURE(angle);
        const Radians wrapped = wrappedAzimuth(angle);
        CHECK(wrapped >= 0);
        CHECK(wrapped < 2 * kPi);
        CHECK(std::abs(std::sin(wrapped) - std::sin(angle)) < 1e-9);
        CHECK(std::abs(std::cos(wrapped) - std::cos(angle)) < 1e-9);
        CHECK(wrappedAzimuth(wrapped) == wrapped);
    }
}

TEST_CASE("an azimuth of any number is wrapped, and one that is no number is 0") {
    for (const double angle : {1e10, -1e10, 1e15, -3.3e17, 1e30, -1e300}) {
        CAPTURE(angle);
        CHECK(wrappedAzimuth(angle) >= 0);
        CHECK(wrappedAzimuth(angle) < 2 * kPi);
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double angle : {kInfinity, -kInfinity, std::nan("")}) {
        CHECK(wrappedAzimuth(angle) == 0);
    }
}

TEST_CASE("the angle between two directions is symmetric, exact when small, and pi when opposite") {
    CHECK(angleBetween({0.7, 2}, {0.7, 2}) == 0);
    CHECK(angleBetween({0.7, 2}, {0.7 + 1e-9, 2}) == doctest::Approx(1e-9).epsilon(1e-5));
    CHECK(angleBetween({kPi / 2, 0}, {kPi / 2, kPi}) == doctest::Approx(kPi));
    CHECK(angleBetween({kPi / 2, 0}, {kPi / 2, 1}) == doctest::Approx(1));
    CHECK(angleBetween({0.2, 0.3}, {1.1, 4}) == angleBetween({1.1, 4}, {0.2, 0.3}));
}

TEST_CASE("degrees and radians are each other's inverse") {
    for (const double degrees : {-360.0, 0.0, 15.0, 75.0, 337.5}) {
        CHECK(degreesFromRadians(radiansFromDegrees(degrees)) == doctest::Approx(degrees));
    }
}

TEST_SUITE_END();
