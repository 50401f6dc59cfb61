// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/demo_cloth.h"

#include "abrdf/angular_grid.h"
#include "abrdf/direction.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace {

using Imath::V3f;

constexpr int kSize = 24;

V3f unit(double thetaDegrees, double phiDegrees) {
    return V3f(
        vectorFromDirection({radiansFromDegrees(thetaDegrees), radiansFromDegrees(phiDegrees)}));
}

std::vector<Rgb> rendered(const DemoCloth& cloth, const V3f& light, const V3f& view) {
    const auto width = static_cast<std::size_t>(cloth.size());
    std::vector<Rgb> image(width * width);
    cloth.render(light, view, image);
    return image;
}

float meanGreen(const DemoCloth& cloth, const V3f& light, const V3f& view) {
    float sum = 0;
    const std::vector<Rgb> image = rendered(cloth, light, view);
    for (const Rgb& color : image) sum += color.g;
    return sum / static_cast<float>(image.size());
}

float largest(Rgb c) {
    return std::max({c.r, c.g, c.b});
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("a weave repeats, and its warp covers two thirds of it") {
        int warp = 0;
        for (int y = 0; y < 60; ++y) {
            for (int x = 0; x < 60; ++x) {
                const float u = (static_cast<float>(x) + 0.5F) / 10;
                const float v = (static_cast<float>(y) + 0.5F) / 10;
                const WeavePoint point = weaveAt(u, v);
                warp += point.family == YarnFamily::kWarp ? 1 : 0;
                CHECK(weaveAt(u + kWeaveYarns, v - kWeaveYarns).height ==
                      doctest::Approx(point.height).epsilon(1e-4));
            }
        }
        CHECK(warp == 2400);
    }

    TEST_CASE("the slopes of a weave are the derivatives of its height") {
        for (const float x : {0.3F, 1.7F, 2.4F}) {
            const WeavePoint point = weaveAt(x, 3.6F);
            const float step = 0.01F;
            const float dx = weaveAt(x + step, 3.6F).height - weaveAt(x - step, 3.6F).height;
            const float dy = weaveAt(x, 3.6F + step).height - weaveAt(x, 3.6F - step).height;
            CHECK(point.slopeX == doctest::Approx(dx / (2 * step)).epsilon(0.01));
            CHECK(point.slopeY == doctest::Approx(dy / (2 * step)).epsilon(0.01));
        }
    }

    TEST_CASE("an image is its texels") {
        const DemoCloth cloth(kSize, 1);
        const V3f light = unit(45, 100);
        const V3f view = unit(60, 280);
        const std::vector<Rgb> image = rendered(cloth, light, view);
        CHECK(image[0] == cloth.radiance(0, 0, light, view));
        CHECK(image[kSize * 5 + 7] == cloth.radiance(7, 5, light, view));
    }

    TEST_CASE("the same seed makes the same cloth, another seed another one") {
        const V3f light = unit(30, 0);
        const V3f view = unit(15, 60);
        const std::vector<Rgb> image = rendered(DemoCloth(kSize, 1), light, view);
        CHECK(image == rendered(DemoCloth(kSize, 1), light, view));
        CHECK(image != rendered(DemoCloth(kSize, 2), light, view));
    }

    TEST_CASE("warp and weft have distinct colours") {
        const DemoCloth cloth(6 * kWeaveYarns, 1);
        int bluish = 0;
        int yellowish = 0;
        for (const Rgb& color : rendered(cloth, unit(60, 90), unit(0, 0))) {
            bluish += color.b > 1.5F * color.r ? 1 : 0;
            yellowish += color.r > 1.2F * color.b ? 1 : 0;
        }
        CHECK(bluish > 36 * 36 / 2);
        CHECK(yellowish > 36 * 36 / 5);
    }

    TEST_CASE("the cloth changes when it is turned") {
        const DemoCloth cloth(4 * kSize, 1);
        // Light scattered by warp threads stays in the plane across them.
        const float acrossWarp = meanGreen(cloth, unit(75, 0), unit(30, 180));
        const float alongWarp = meanGreen(cloth, unit(75, 90), unit(30, 270));
        CHECK(acrossWarp > 1.5F * alongWarp);
    }

    TEST_CASE("a texel of the cloth is not reciprocal") {
        const DemoCloth cloth(kSize, 1);
        const V3f a = unit(60, 0);
        const V3f b = unit(15, 90);
        float difference = 0;
        float sum = 0;
        for (int y = 0; y < kSize; ++y) {
            for (int x = 0; x < kSize; ++x) {
                const float there = cloth.radiance(x, y, a, b).g / a.z;
                const float back = cloth.radiance(x, y, b, a).g / b.z;
                difference += std::fabs(there - back);
                sum += there + back;
            }
        }
        CHECK(difference > 0.05F * sum);
    }

    TEST_CASE("highlights exceed 1 by far, but few values do") {
        const DemoCloth cloth(kSize, 1);
        std::size_t values = 0;
        std::size_t clipped = 0;
        float brightest = 0;
        const AngularGrid grid(ubo81Directions());
        for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
            const V3f light(vectorFromDirection(grid.pair(pair).light));
            const V3f view(vectorFromDirection(grid.pair(pair).view));
            const int x = static_cast<int>(pair * 7) % kSize;
            for (int y = 0; y < kSize; ++y, ++values) {
                const Rgb color = cloth.radiance(x, y, light, view);
                REQUIRE(isFinite(color));
                REQUIRE_FALSE(isNegative(color));
                brightest = std::max(brightest, largest(color));
                clipped += largest(color) > 1 ? 1U : 0U;
            }
        }
        CHECK(brightest > 5);
        CHECK(brightest < 60);
        CHECK(static_cast<double>(clipped) < 0.01 * static_cast<double>(values));
    }

    TEST_CASE("nothing is lit or seen from below") {
        const DemoCloth cloth(1, 1);
        CHECK(cloth.radiance(0, 0, V3f(0, 0, -1), V3f(0, 0, 1)) == Rgb{});
        CHECK(cloth.radiance(0, 0, V3f(0, 0, 1), V3f(1, 0, 0)) == Rgb{});
    }

    TEST_CASE("a size out of range is an error") {
        CHECK_THROWS_AS(DemoCloth(0, 1), std::invalid_argument);
        CHECK_THROWS_AS(DemoCloth(kMaxDemoSize + 1, 1), std::invalid_argument);
    }
}

}  // namespace abrdf
