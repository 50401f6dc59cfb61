// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/render.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "stages/preview/built_in_light.h"
#include "tests/support/linear_look_up.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

using namespace abrdf;

namespace {

const Rgb kAlbedo = {0.8F, 0.5F, 0.2F};

Atlas lambertian() {
    return syntheticAtlas(
        AngularGrid(ubo81Directions()), 1, 1,
        [](const LightAndView& p, int, int) { return lambertianWithGloss(p, kAlbedo, 0, 1); });
}

Atlas glossy() {
    return syntheticAtlas(AngularGrid(ubo81Directions()), 1, 1,
                          [](const LightAndView& p, int, int) {
                              return lambertianWithGloss(p, {0.1F, 0.15F, 0.3F}, 4, 0.2);
                          });
}

Scene sceneOf(const Surface& surface, std::vector<Light> lights, std::vector<Light> sky) {
    Scene scene;
    scene.surface = &surface;
    scene.camera.elevation = radiansFromDegrees(25);
    scene.lights = std::move(lights);
    scene.sky = std::move(sky);
    return scene;
}

/// Mean and largest CIE 1976 Delta E of covered pixels.
struct Difference {
    double mean = 0;
    double most = 0;
};

Difference difference(const Picture& a, const Picture& b) {
    Difference result;
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.count(); ++i) {
        if (a.alpha[i] < 1 || b.alpha[i] < 1) continue;
        const double d = deltaE76(labFromLinearRec709(a.color[i]), labFromLinearRec709(b.color[i]));
        result.mean += d;
        result.most = std::max(result.most, d);
        ++count;
    }
    REQUIRE(count > 100);
    result.mean /= static_cast<double>(count);
    return result;
}

std::vector<Light> studio(int samples) {
    std::vector<Light> lights = lightsOf(studioEnvironment(), samples);
    normalize({&lights});
    return lights;
}

bool sameBits(const Picture& a, const Picture& b) {
    return a.count() == b.count() &&
           std::memcmp(a.color.data(), b.color.data(), a.count() * sizeof(Rgb)) == 0 &&
           a.alpha == b.alpha && a.depth == b.depth;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("in a furnace of radiance 1 a Lambertian shows its albedo, on any shape without folds") {
    const Atlas atlas = lambertian();
    const Material material(atlas);
    EnvironmentMap white{128, 64, {}};
    white.radiance.assign(128 * 64, {1, 1, 1});
    for (const auto& surface : {makeSphere(), makePlane()}) {
        const Picture picture =
            render(material, sceneOf(*surface, {}, lightsOf(white, 4096)), 48, 48, {});
        for (std::size_t i = 0; i < picture.count(); ++i) {
            if (picture.alpha[i] < 1) continue;
            // The chord of the cosine between rings 15 degrees apart lies below it by up to 0.9 %.
            CHECK(picture.color[i].r == doctest::Approx(kAlbedo.r).epsilon(0.012));
            CHECK(picture.color[i].b == doctest::Approx(kAlbedo.b).epsilon(0.012));
        }
    }
}

TEST_CASE(
    "under one light a pixel is the atlas's as a ratio to the lobe, and black past the horizon") {
    const Atlas atlas = glossy();
    const Material material(atlas);
    const LobeProfile lobe(atlas);
    CHECK(lobe.at(0.3) < 0.5);
    std::vector<Rgb> ratios = atlas.pixels();
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        const LightAndView p = atlas.header().grid.pair(i);
        ratios[i] *= static_cast<float>(
            1 / lobe.at(halfAngleOf(vectorFromDirection(p.light), vectorFromDirection(p.view))));
    }
    const Atlas ratioAtlas(atlas.header(), ratios);
    const auto sphere = makeSphere();
    const Imath::V3d towards = vectorFromAzimuthElevation(1.2, 0.5);
    const Scene scene = sceneOf(*sphere, {{towards, {1, 2, 0.5F}}}, {});
    const Picture picture = render(material, scene, 96, 96, {});
    const Camera camera(scene.camera, 96, 96);
    int beyond = 0;
    int compared = 0;
    for (int i = 0; i < 96 * 96; ++i) {
        const auto pixel = static_cast<std::size_t>(i);
        const Ray ray = camera.rayThrough(i % 96 + 0.5, i / 96 + 0.5);
        const auto point = sphere->hit(ray);
        // Pixels of many samples, at the edge, are left out.
        if (!point || std::abs(picture.depth[pixel] - point->distance) > 1e-6) continue;
        ++compared;
        const Imath::V3d local = point->frame.local(towards);
        Rgb expected;
        if (local.z > 0) {
            Direction light = directionFromVector(local);
            const double theta = light.theta;
            constexpr Radians kLast = radiansFromDegrees(75);
            light.theta = std::min(light.theta, kLast);
            const double fade = theta > kLast ? std::cos(theta) / std::cos(kLast) : 1;
            beyond += theta > kLast ? 1 : 0;
            const Imath::V3d view = point->frame.local(-ray.direction);
            expected = static_cast<float>(fade * lobe.at(halfAngleOf(local, view))) *
                       linearLookUp(ratioAtlas, light, directionFromVector(view));
        }
        CHECK(std::abs(picture.color[pixel].r - expected.r) < 2e-5);
        CHECK(std::abs(picture.color[pixel].g - 2 * expected.g) < 2e-5);
        CHECK(std::abs(picture.color[pixel].b - 0.5F * expected.b) < 2e-5);
        CHECK((Imath::V3d(picture.normals[pixel]) - point->frame.normal).length() < 1e-6);
    }
    CHECK(beyond > 20);
    CHECK(compared > 3000);
}

TEST_CASE("values without their cosine are given it back") {
    const AngularGrid grid(ubo81Directions());
    const auto one = [](const LightAndView&, int, int) { return Rgb{1, 1, 1}; };
    const Atlas divided = syntheticAtlas(grid, 1, 1, one, Cosine::kDivided);
    const Material material(divided);
    for (const double theta : {0.0, 0.4, 1.2, 1.5}) {
        CHECK(material.lightFactor(theta) == doctest::Approx(std::cos(theta)));
    }
    CHECK(material.lightFactor(1.6) == 0);
    const Material kept(syntheticAtlas(grid, 1, 1, one));
    CHECK(kept.lightFactor(1.2) == 1);
    CHECK(kept.lightFactor(1.5) == doctest::Approx(std::cos(1.5) / std::cos(grid.maxTheta())));
}

TEST_CASE("gathered at nodes, an environment is as good as every light at every pixel") {
    const Atlas atlas = glossy();
    const Material material(atlas);
    for (const auto& surface : {makeSphere(), makeDrape()}) {
        const Scene scene = sceneOf(*surface, {}, studio(256));
        const Picture picture = render(material, scene, 120, 120, {});
        Picture exact = picture;
        const Camera camera(scene.camera, 120, 120);
        for (std::size_t i = 0; i < exact.count(); ++i) {
            const Ray ray = camera.rayThrough(static_cast<double>(i % 120) + 0.5,
                                              static_cast<double>(i / 120) + 0.5);
            const auto point = surface->hit(ray);
            const bool single = point && std::abs(picture.depth[i] - point->distance) < 1e-6;
            if (!single) exact.alpha[i] = 0;
            if (single) exact.color[i] = radianceAt(material, scene, *point, -ray.direction);
        }
        const Difference off = difference(picture, exact);
        CAPTURE(off.most);
        CHECK(off.mean < 0.2);
    }
}

TEST_CASE("2048 lights for an environment are within 0.5 Delta E of 64 times as many") {
    const auto sphere = makeSphere();
    const Scene few = sceneOf(*sphere, {}, studio(2048));
    const Scene many = sceneOf(*sphere, {}, studio(131'072));
    const Camera camera(few.camera, 24, 24);
    const auto noise = [&](const Atlas& atlas) {
        const Material material(atlas);
        Picture a(24, 24);
        Picture b(24, 24);
        forEachTexelBlock(a.count(), 4, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const Ray ray = camera.rayThrough(static_cast<double>(i % 24) + 0.5,
                                                  static_cast<double>(i / 24) + 0.5);
                const auto point = sphere->hit(ray);
                if (!point) continue;
                a.alpha[i] = b.alpha[i] = 1;
                a.color[i] = radianceAt(material, few, *point, -ray.direction);
                b.color[i] = radianceAt(material, many, *point, -ray.direction);
            }
        });
        return difference(a, b);
    };
    CHECK(noise(glossy()).mean < 0.5);
    const std::vector<Rgb> table = sharedTable("measured81/rgl_chm_orange_f32.bin");
    if (table.empty()) {
        MESSAGE("no ../shared/data: the measured metal is left out");
        return;
    }
    const AngularGrid grid(ubo81Directions());
    const Difference metal = noise(syntheticAtlas(grid, 1, 1, [&](const LightAndView& p, int, int) {
        const auto indexOf = [&](Direction d) { return nearestDirection(grid.lights(), d); };
        return table[grid.pairIndex(indexOf(p.light), indexOf(p.view))];
    }));
    MESSAGE("orange chrome: mean Delta E " << metal.mean << ", largest " << metal.most);
    CHECK(metal.mean < 0.5);
}

TEST_CASE("a map repeats over the shape, edges are smooth, what is not finite is black") {
    const AngularGrid grid(regularDirections(3, 6));
    const Atlas atlas = syntheticAtlas(grid, 2, 2, [](const LightAndView&, int x, int y) {
        if (x == 1 && y == 1) return Rgb{std::numeric_limits<float>::quiet_NaN(), 1, 1};
        return Rgb{x == 0 ? 1.0F : 0.0F, y == 0 ? 1.0F : 0.0F, 0.25F};
    });
    const Material material(atlas);
    const auto plane = makePlane();
    Scene scene = sceneOf(*plane, {{{0, 1, 0}, {1, 1, 1}}}, {});
    scene.camera.elevation = kPi / 2;
    scene.camera.reach = 0.8;
    scene.tiles = 3;
    const Picture picture = render(material, scene, 240, 240, {});
    int partial = 0;
    for (const float alpha : picture.alpha) {
        CHECK(alpha >= 0);
        CHECK(alpha <= 1);
        partial += alpha > 0 && alpha < 1 ? 1 : 0;
    }
    CHECK(partial > 100);
    // Along the row of the upper texels of a tile: 3 tiles of red and not red.
    const auto reds = [&](int row) {
        int changes = 0;
        bool last = false;
        for (int x = 0; x < 240; ++x) {
            const std::size_t i = static_cast<std::size_t>(row) * 240 + static_cast<std::size_t>(x);
            const bool red = picture.color[i].r > 0.5F;
            changes += red != last ? 1 : 0;
            last = red;
        }
        return changes;
    };
    int row = 0;
    while (picture.alpha[static_cast<std::size_t>(row) * 240 + 120] < 1) ++row;
    CHECK(reds(row + 12) == 6);
    for (const Rgb& c : picture.color) CHECK(isFinite(c));
}

TEST_CASE("sizes that are no picture are refused") {
    const Material material(lambertian());
    const auto sphere = makeSphere();
    CHECK_THROWS_AS(render(material, sceneOf(*sphere, {}, {}), 0, 10, {}), std::invalid_argument);
    CHECK_THROWS_AS(render(material, sceneOf(*sphere, {}, {}), 10, 1 << 20, {}),
                    std::invalid_argument);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("threads");

TEST_CASE("one thread and many render the same bits") {
    const Material material(glossy());
    for (const auto& surface : {makeSphere(), makeDrape()}) {
        const Scene scene = sceneOf(*surface, {{{0, 1, 0}, {1, 1, 1}}}, studio(200));
        const Picture one = [&] {
            const ThreadLimit limit(1);
            return render(material, scene, 50, 40, {});
        }();
        const ThreadLimit limit(4);
        CHECK(sameBits(one, render(material, scene, 50, 40, {})));
    }
}

TEST_SUITE_END();
