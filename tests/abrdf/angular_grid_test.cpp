// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/angular_grid.h"

#include "abrdf/angular_interpolation.h"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a direction and its vector are each other's inverse") {
    for (const Direction& d : dome151Directions()) {
        const Direction back = directionFromVector(vectorFromDirection(d));
        CHECK(back.theta == doctest::Approx(d.theta).epsilon(1e-12));
        CHECK(angleBetween(back, d) < 1e-7);
    }
    CHECK(wrappedAzimuth(-kPi / 2) == doctest::Approx(1.5 * kPi));
    CHECK(wrappedAzimuth(2 * kPi) == 0);
}

TEST_CASE("the named grids have the databases' numbers of directions") {
    CHECK(gridFromName("ubo81").pairCount() == 81 * 81);
    CHECK(gridFromName("dome151").pairCount() == 151 * 151);
    CHECK(gridFromName("utia288").pairCount() == 288 * 288);
    CHECK(gridFromName("regular:3x5").lights().size() == 15);
    CHECK(degreesFromRadians(gridFromName("utia288").maxTheta()) == doctest::Approx(75));
    CHECK_THROWS_AS(gridFromName("regular:3"), std::invalid_argument);
    CHECK_THROWS_AS(gridFromName("nonsense"), std::invalid_argument);
    CHECK_THROWS_AS(AngularGrid({{kPi, 0}}, {{0, 0}}), std::invalid_argument);
}

TEST_CASE("dome151 is the dome of UBO2014") {
    std::ifstream stream(std::string(ABRDF_SHARED_DATA) + "/ubo2014/directions_f64_3x151.bin",
                         std::ios::binary);
    if (!stream) {
        MESSAGE("skipped: ../shared/data/ubo2014 is absent");
        return;
    }
    double table[3][151];
    REQUIRE(stream.read(reinterpret_cast<char*>(table), sizeof table));
    const std::vector<Direction> dome = dome151Directions();
    for (std::size_t i = 0; i < dome.size(); ++i) {
        CHECK(angleBetween(dome[i], {kPi / 2 - table[1][i], table[0][i]}) < 2e-6);
    }
}

TEST_CASE("a CSV of directions names the line that is wrong") {
    const auto file = std::filesystem::temp_directory_path() / "abrdf-grid-test.csv";
    std::ofstream(file) << "theta_deg,phi_deg\n# a comment\n0,0\n30, 90\n45,-90\n";
    const std::vector<Direction> directions = directionsFromCsv(file);
    REQUIRE(directions.size() == 3);
    CHECK(degreesFromRadians(directions[2].phi) == doctest::Approx(270));
    std::ofstream(file) << "0,0\n95,0\n";
    try {
        directionsFromCsv(file);
        FAIL("a theta of 95 degrees passed");
    } catch (const std::runtime_error& error) {
        CHECK(std::string(error.what()).find(":2:") != std::string::npos);
    }
    std::filesystem::remove(file);
}

TEST_CASE("interpolation is exact at directions, periodic, and its weights sum to 1") {
    for (const auto& directions :
         {ubo81Directions(), dome151Directions(), regularDirections(4, 7)}) {
        const AngularInterpolation interpolation(directions);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const DirectionWeights w = interpolation.weights(directions[i]);
            REQUIRE(w.terms.size() == 1);
            // A regular grid lists its pole often; any of them is the pole.
            CHECK(angleBetween(directions[w.terms[0].index], directions[i]) < 1e-9);
            CHECK(w.terms[0].weight == doctest::Approx(1));
        }
        for (int k = 0; k < 500; ++k) {
            const Direction target = {0.0026 * k, 0.37 * k};
            const DirectionWeights w = interpolation.weights(target);
            const DirectionWeights turned =
                interpolation.weights({target.theta, target.phi - 4 * kPi});
            double sum = 0;
            for (std::size_t i = 0; i < w.terms.size(); ++i) {
                CHECK(w.terms[i].weight > 0);
                CHECK(turned.terms[i].index == w.terms[i].index);
                sum += w.terms[i].weight;
            }
            CHECK(sum == doctest::Approx(1));
            CHECK(w.extrapolated == (target.theta > radiansFromDegrees(75.02)));
        }
    }
}

TEST_CASE("interpolation reproduces a function linear in theta, and in phi along a ring") {
    const std::vector<Direction> directions = ubo81Directions();
    const AngularInterpolation interpolation(directions);
    const auto valueAt = [&](Direction target, auto f) {
        double value = 0;
        const DirectionWeights w = interpolation.weights(target);
        for (std::size_t i = 0; i < w.terms.size(); ++i) {
            value += w.terms[i].weight * f(directions[w.terms[i].index]);
        }
        return value;
    };
    for (int k = 1; k < 50; ++k) {
        const Direction target = {radiansFromDegrees(1.5 * k), radiansFromDegrees(6.9 * k)};
        CHECK(valueAt(target, [](Direction d) { return 2 + d.theta; }) ==
              doctest::Approx(2 + target.theta));
        const Direction onRing = {radiansFromDegrees(45), radiansFromDegrees(6.8 * k)};
        if (onRing.phi < radiansFromDegrees(340)) {
            CHECK(valueAt(onRing, [](Direction d) { return d.phi; }) ==
                  doctest::Approx(onRing.phi));
        }
    }
}

TEST_CASE(
    "scattered directions are interpolated too: exactly at each, within their range elsewhere") {
    std::vector<Direction> scattered;
    for (int i = 0; i < 20; ++i) scattered.push_back({0.06 * i, 2.4 * i});
    const AngularInterpolation interpolation(scattered);
    CHECK(interpolation.weights(scattered[7]).terms[0].index == 7);
    const DirectionWeights w = interpolation.weights({0.5, 1});
    double sum = 0;
    for (std::size_t i = 0; i < w.terms.size(); ++i) sum += w.terms[i].weight;
    CHECK(sum == doctest::Approx(1));
}

TEST_SUITE_END();
