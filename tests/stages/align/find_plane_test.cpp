// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/find_plane.h"

#include "abrdf/angular_grid.h"
#include "abrdf/for_each_texel.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

namespace {

constexpr int kSize = 48;

/// A texture without symmetry whose images are lit and seen from all of a grid's pairs.
struct Scene {
    std::vector<LightAndView> directions;
    ImageStack images;
};

/// Waves over a tile of kSize texels; `period` other than that leaves its edges unjoined.
float textureAt(double x, double y, double period) {
    const double u = 2 * kPi * x / period;
    const double v = 2 * kPi * y / period;
    return static_cast<float>(0.3 + 0.1 * std::sin(3 * u + 1) * std::cos(2 * v) +
                              0.07 * std::sin(5 * v - 2 * u) + 0.05 * std::cos(7 * u + 4 * v + 2));
}

/// Height 0 of the texture lies `height` texels above the plane that images are rectified to.
Scene sceneAt(double height, double period = kSize) {
    const AngularGrid grid(regularDirections(4, 6));
    std::vector<std::size_t> pairs;
    Scene scene;
    for (std::size_t pair = 0; pair < grid.pairCount(); pair += 7) {
        pairs.push_back(pair);
        scene.directions.push_back(grid.pair(pair));
    }
    scene.images = ImageStack(pairs, kSize, kSize);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const LightAndView& pair = scene.directions[i];
        const Shift shift = parallax(height, pair.view);
        const auto light = static_cast<float>(std::cos(0.8 * pair.light.theta));
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const float value = light * textureAt(x - shift.x, y - shift.y, period);
                scene.images.image(i)[static_cast<std::size_t>(y * kSize + x)] = {
                    value, 0.8F * value, 0.5F * value};
            }
        }
    }
    return scene;
}

PlaneFit fitOf(const Scene& scene, Edges edges = Edges::kPeriodic) {
    return findPlane(scene.images, scene.directions, {.edges = edges});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the height of a shifted texture is found, above and below its plane") {
    for (const double height : {3.3, -2.2, 0.8}) {
        CAPTURE(height);
        const PlaneFit fit = fitOf(sceneAt(height));
        CHECK(fit.height == doctest::Approx(height).epsilon(0.03));
        CHECK(fit.drop() > 0.3);
    }
}

TEST_CASE("a texture at its plane is left there") {
    const PlaneFit fit = fitOf(sceneAt(0));
    CHECK(fit.height == 0);
    CHECK(std::abs(fit.best) < 0.1);
}

TEST_CASE("a cropped sample is searched without what leaves its edges") {
    const Scene scene = sceneAt(1.7, 41);
    CHECK_FALSE(isPeriodic(scene.images));
    CHECK(isPeriodic(sceneAt(1.7).images));
    CHECK(fitOf(scene, Edges::kCropped).height == doctest::Approx(1.7).epsilon(0.03));
}

TEST_CASE("images without detail, too small or too few have no plane") {
    Scene plain = sceneAt(2);
    for (std::size_t i = 0; i < plain.images.pairs().size(); ++i) {
        for (Rgb& c : plain.images.image(i)) c = {0.5F, 0.5F, 0.5F};
    }
    CHECK(fitOf(plain).height == 0);
    Scene few = sceneAt(2);
    few.directions.resize(4);
    few.images = ImageStack({0, 1, 2, 3}, kSize, kSize);
    CHECK(fitOf(few).height == 0);
    Scene small = sceneAt(2);
    small.images = ImageStack(small.images.pairs(), 8, 8);
    CHECK(fitOf(small).height == 0);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("the plane has the same bits on any number of threads") {
    const Scene scene = sceneAt(2.6);
    const double first = fitOf(scene).height;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        CHECK(fitOf(scene).height == first);
    }
}

TEST_SUITE_END();
