// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/built_in_light.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace abrdf;

namespace {

EnvironmentMap uniform(int width, int height, float value) {
    EnvironmentMap map{width, height, {}};
    map.radiance.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                        {value, value, value});
    return map;
}

double totalOf(const std::vector<Light>& lights) {
    double sum = 0;
    for (const Light& light : lights) sum += static_cast<double>(light.strength.g);
    return sum;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("light from everywhere, 1 in radiance, shows every white Lambertian as 1") {
    const std::vector<Light> lights = lightsOf(uniform(256, 128, 1), 4096);
    CHECK(lights.size() == 4096);
    for (const Imath::V3d& n : {Imath::V3d(0, 1, 0), Imath::V3d(0, -1, 0), Imath::V3d(0.6, 0, 0.8),
                                Imath::V3d(-0.36, 0.48, 0.8)}) {
        CHECK(static_cast<double>(whiteShows(lights, n).g) == doctest::Approx(1).epsilon(0.005));
    }
}

TEST_CASE("however few lights stand for a map, they have all its energy: 4 pi over pi of white") {
    for (const int count : {1, 7, 100, 100'000}) {
        CHECK(totalOf(lightsOf(uniform(64, 32, 1), count)) == doctest::Approx(4).epsilon(1e-6));
    }
    CHECK(lightsOf(uniform(64, 32, 1), 100'000).size() == 64 * 32);
    CHECK(lightsOf(uniform(64, 32, 0), 100).empty());
    // Fine maps are boxed down first, and keep their energy.
    CHECK(totalOf(lightsOf(uniform(2500, 40, 1), 50)) == doctest::Approx(4).epsilon(0.01));
}

TEST_CASE("a lamp in the dark is found to a pixel, whatever else the map holds") {
    EnvironmentMap map = uniform(512, 256, 0);
    map.radiance[map.index(100, 60)] = {1000, 500, 100};
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    map.radiance[map.index(300, 20)] = {kNaN, -5, std::numeric_limits<float>::infinity()};
    const std::vector<Light> lights = lightsOf(map, 64);
    REQUIRE(lights.size() == 1);
    CHECK((lights[0].direction - directionInMap(map, 100.5, 60.5)).length() < 1e-6);
    CHECK(lights[0].strength.r == doctest::Approx(2 * lights[0].strength.g));
}

TEST_CASE("the middle of a map lies behind the object, its right half to the right") {
    const EnvironmentMap map = uniform(4, 2, 1);
    CHECK((directionInMap(map, 2, 1) - Imath::V3d(0, 0, -1)).length() < 1e-12);
    CHECK((directionInMap(map, 3, 1) - Imath::V3d(1, 0, 0)).length() < 1e-12);
    CHECK((directionInMap(map, 1, 0) - Imath::V3d(0, 1, 0)).length() < 1e-12);
    const auto light = turned({{{0, 0, 1}, {1, 1, 1}}}, radiansFromDegrees(90));
    CHECK((light[0].direction - Imath::V3d(1, 0, 0)).length() < 1e-12);
}

TEST_CASE("the studio is neutral, the sky blue and brightest near its sun") {
    for (const Rgb& c : studioEnvironment().radiance) {
        CHECK(c.r == c.g);
        CHECK(c.g == c.b);
        CHECK(c.r > 0);
    }
    const Imath::V3d sun = skySunDirection();
    const EnvironmentMap sky = skyEnvironment(sun);
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < sky.radiance.size(); ++i) {
        CHECK(isFinite(sky.radiance[i]));
        if (sky.radiance[i].g > sky.radiance[brightest].g) brightest = i;
    }
    const Imath::V3d found = directionInMap(sky, static_cast<double>(brightest % 512) + 0.5,
                                            static_cast<double>(brightest / 512) + 0.5);
    CHECK((found ^ sun) > std::cos(radiansFromDegrees(3)));
    const Rgb opposite = sky.radiance[sky.index(320, 40)];
    CHECK(opposite.b > 1.3F * opposite.r);
    // More light from the sun than from the sky, on the ground.
    const Light disc = skySun(sky);
    CHECK(static_cast<double>(disc.strength.g) * sun.y >
          2 * static_cast<double>(whiteShows(lightsOf(sky, 500), {0, 1, 0}).g));
}

TEST_CASE("normalized, the brightest white Lambertian shows 1 and the ratio of lights stays") {
    std::vector<Light> a{{{0, 1, 0}, {3, 3, 3}}};
    std::vector<Light> b{{{0, 1, 0}, {1, 1, 1}}};
    normalize({&a, &b});
    CHECK(a[0].strength.g == doctest::Approx(0.75));
    CHECK(b[0].strength.g == doctest::Approx(0.25));
}

TEST_SUITE_END();
