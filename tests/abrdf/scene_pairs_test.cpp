// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/scene_pairs.h"

#include "abrdf/pair_interpolation.h"
#include "abrdf/random.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string>

using namespace abrdf;

namespace {

ScenePairs sceneOf(const std::string& text) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "arc.csv";
    std::ofstream(file) << text;
    return scenePairsFromCsv(file);
}

std::string faultOf(const std::string& text) {
    try {
        sceneOf(text);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "none";
}

double sumOf(const std::vector<double>& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

Direction degrees(double theta, double phi) {
    return {radiansFromDegrees(theta), radiansFromDegrees(phi)};
}

/// Pairs at random all over both hemispheres.
ScenePairs scattered(std::size_t count) {
    Random random(5);
    ScenePairs scene;
    for (std::size_t i = 0; i < count; ++i) {
        const auto direction = [&] {
            return degrees(random.uniform(0, 75), random.uniform(0, 360));
        };
        scene.pairs.push_back({direction(), direction()});
        scene.weights.push_back(1 / static_cast<double>(count));
    }
    return scene;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a pairs file is read: names, comments, weights or none, equal pairs added up") {
    const ScenePairs scene = sceneOf(
        "theta_i,phi_i,theta_v,phi_v,weight\n# a light\n30,0,45,90,2\n\n30, 360, 45, 90, 1\r\n"
        "0,17,45,-90\n0 99 45 270\n60,0,0,0,0\n");
    REQUIRE(scene.pairs.size() == 3);
    CHECK(scene.name == "arc");
    CHECK(scene.weights[0] == doctest::Approx(0.6));
    CHECK(scene.weights[1] == doctest::Approx(0.4));
    CHECK(scene.weights[2] == 0);
    CHECK(scene.pairs[0].light.theta == doctest::Approx(radiansFromDegrees(30)));
    CHECK(scene.pairs[1].view.phi == doctest::Approx(radiansFromDegrees(270)));
}

TEST_CASE("what is wrong in a pairs file is told with its line") {
    const auto tells = [](const std::string& text, const std::string& line,
                          const std::string& what) {
        const std::string fault = faultOf(text);
        CAPTURE(fault);
        CHECK(fault.find(line) != std::string::npos);
        CHECK(fault.find(what) != std::string::npos);
    };
    tells("30,0,45,90\n95,0,45,90\n", ".csv:2:", "theta 95 degrees is not above the horizon");
    tells("# c\n30,0,-1,90\n", ".csv:2:", "theta -1 degrees");
    tells("30,0,45,1e9\n", ".csv:1:", "no azimuth");
    tells("30,0,45,90,-1\n", ".csv:1:", "weight -1");
    // A field that is empty must not be filled with its neighbour.
    for (const char* row : {"30,0,,45,60\n", "30,0,45,90,\n", "30,0,45\n", "30,0,45,90,1,2\n",
                            "30,0,45,90,x\n", "nan,0,45,90\n"}) {
        CAPTURE(row);
        tells(row, ".csv:1:", "is not a row");
    }
    tells("30,0,45,90\ntheta_i,phi_i,theta_v,phi_v\n", ".csv:2:", "is not a row");
    tells("theta_i,phi_i,theta_v,phi_v\nabc,0,60,210\n1,2,3,4\n", ".csv:2:", "is not a row");
    tells("theta_v,phi_v,theta_i,phi_i\n30,0,60,210\n", ".csv:", "in the order theta_i");
    tells(std::string("30,0,45,90\n\0\0\n", 14), ".csv:2:", "'\\x00\\x00' is not a row");
    tells("", ".csv:", "holds no pair");
    tells("theta_i,phi_i,theta_v,phi_v\n# nothing\n", ".csv:", "holds no pair");
    tells("30,0,45,90,0\n20,0,45,90,0\n", ".csv:", "sum to 0");
}

TEST_CASE("what spreadsheets write is read, and weights of any size") {
    const ScenePairs scene =
        sceneOf("\xef\xbb\xbfTheta_i,Phi_i,Theta_v,Phi_v\r\n+30,0,45,90\r\n20,0,45,90\r\n");
    CHECK(scene.weights == std::vector<double>{0.5, 0.5});
    CHECK(sceneOf("30,0,45,90,1.7e308\n20,0,45,90,1.7e308\n").weights ==
          std::vector<double>{0.5, 0.5});
}

TEST_CASE("few directions are the grid themselves, and each pair matters by its own weight") {
    const ScenePairs scene = sceneOf("30,0,10,0,3\n30,0,20,0,1\n50,120,10,0,4\n80,0,80,0,0\n");
    const AngularGrid grid = sceneGrid(scene, AngularGrid(ubo81Directions()));
    CHECK(grid.lights().size() == 2);  // What has no weight needs no direction.
    CHECK(grid.views().size() == 2);
    const std::vector<double> weights = sceneWeights(scene, grid);
    CHECK(weights == std::vector<double>{0.375, 0.125, 0.5, 0});
}

TEST_CASE("many directions of one list leave the other list its own") {
    ScenePairs scene = scattered(500);
    for (LightAndView& pair : scene.pairs) pair.light = degrees(45, 30);
    const AngularGrid base(ubo81Directions());
    const AngularGrid grid = sceneGrid(scene, base);
    CHECK(grid.lights() == std::vector<Direction>{degrees(45, 30)});
    CHECK(grid.views() == base.views());
    const std::vector<double> weights = sceneWeights(scene, grid);
    CHECK(sumOf(weights) == doctest::Approx(1).epsilon(1e-5));
    for (const double weight : weights) CHECK(weight >= 0);
}

TEST_CASE("of the base's rings those are kept among which the scene is interpolated, unchanged") {
    ScenePairs scene = scattered(500);
    for (LightAndView& pair : scene.pairs) {
        pair.light = degrees(45, 30);
        pair.view.theta = std::min(pair.view.theta, radiansFromDegrees(20));
    }
    const AngularGrid base({degrees(45, 30)}, ubo81Directions());
    const AngularGrid grid = sceneGrid(scene, base);
    CHECK(grid.views().size() < base.views().size());
    CHECK(grid.views().size() > 7);
    const auto values = [](const AngularGrid& of) {
        std::vector<Rgb> result;
        for (const LightAndView& pair : pairsOf(of)) {
            const double v = 1 + std::sin(pair.view.theta) * std::cos(3 * pair.view.phi);
            result.push_back({static_cast<float>(v), 1, 0});
        }
        return result;
    };
    const PairInterpolation small(grid);
    const PairInterpolation whole(base);
    const std::vector<Rgb> ofSmall = values(grid);
    const std::vector<Rgb> ofWhole = values(base);
    for (const LightAndView& pair : scene.pairs) {
        CHECK(small.value(pair, ofSmall).r ==
              doctest::Approx(whole.value(pair, ofWhole).r).epsilon(1e-5));
    }
}

TEST_CASE("weights of a grid are the adjoint of its interpolation") {
    const ScenePairs scene = scattered(200);
    const AngularGrid grid(ubo81Directions());
    const std::vector<double> weights = sceneWeights(scene, grid);
    Random random(8);
    std::vector<double> values(grid.pairCount());
    for (double& value : values) value = random.uniform();
    const PairInterpolation interpolation(grid);
    double ofScene = 0;
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        for (const WeightedPair& source : interpolation.weights(scene.pairs[i])) {
            ofScene += scene.weights[i] * static_cast<double>(source.weight) * values[source.pair];
        }
    }
    double ofGrid = 0;
    for (std::size_t pair = 0; pair < values.size(); ++pair) ofGrid += weights[pair] * values[pair];
    CHECK(ofGrid == doctest::Approx(ofScene));
}

TEST_CASE("a choice by weights meets each as often as it weighs, and none that weighs nothing") {
    std::vector<double> weights(1000, 0);
    weights[10] = 3;
    for (std::size_t i = 500; i < 600; ++i) weights[i] = 0.01;
    const std::vector<std::size_t> chosen = spreadByWeight(weights, 400);
    REQUIRE(chosen.size() == 400);
    CHECK(std::count(chosen.begin(), chosen.end(), std::size_t{10}) == 300);
    for (const std::size_t i : chosen) CHECK(weights[i] > 0);
    CHECK(std::is_sorted(chosen.begin(), chosen.end()));
    CHECK(chosen.back() > 590);
    CHECK(spreadByWeight(std::vector<double>{0, 1, 0}, 9) == std::vector<std::size_t>{1, 1, 1});
}

TEST_SUITE_END();
