// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/surface.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <stdexcept>

using namespace abrdf;

namespace {

std::array<std::unique_ptr<Surface>, 3> shapes() {
    return {makeSphere(), makePlane(), makeDrape()};
}

double offBy(const Imath::V3d& a, const Imath::V3d& b) {
    return (a - b).length();
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("every shape is met in the middle of its picture, where the camera looks at its front") {
    CameraOptions options;
    options.elevation = radiansFromDegrees(40);
    const Camera camera(options, 101, 101);
    for (const auto& shape : shapes()) {
        const Ray ray = camera.rayThrough(50.5, 50.5);
        const auto point = shape->hit(ray);
        REQUIRE(point);
        CHECK((point->frame.normal ^ ray.direction) < 0);
        CHECK(offBy(point->position, ray.origin + ray.direction * point->distance) < 1e-12);
        CHECK_FALSE(shape->hit(camera.rayThrough(0.5, 0.5)));
        CHECK_FALSE(shape->hit({ray.origin, -ray.direction}));
    }
}

TEST_CASE("frames are right-handed and orthonormal, and those of the point that was met") {
    CameraOptions options;
    options.elevation = radiansFromDegrees(35);
    const Camera camera(options, 40, 40);
    for (const auto& shape : shapes()) {
        for (int i = 0; i < 1600; ++i) {
            const auto point = shape->hit(camera.rayThrough(i % 40 + 0.3, i / 40 + 0.6));
            if (!point) continue;
            const Frame& f = point->frame;
            CHECK(offBy(f.x.cross(f.y), f.normal) < 1e-9);
            CHECK(std::abs(f.x ^ f.y) < 1e-9);
            CHECK(std::abs(f.x.length() - 1) + std::abs(f.normal.length() - 1) < 1e-9);
            const Frame again = shape->frameAt(point->u, point->v);
            CHECK(offBy(again.normal, f.normal) + offBy(again.x, f.x) < 1e-9);
        }
    }
}

TEST_CASE("the sphere fits its picture, touches no edge, and is nearest in the middle") {
    const auto sphere = makeSphere();
    for (const double field : {5.0, 25.0, 90.0}) {
        CameraOptions options;
        options.fieldOfView = radiansFromDegrees(field);
        const Camera camera(options, 200, 100);
        CHECK(sphere->hit(camera.rayThrough(100, 6)));
        CHECK(sphere->hit(camera.rayThrough(56, 50)));
        CHECK_FALSE(sphere->hit(camera.rayThrough(100, 1)));
        CHECK_FALSE(sphere->hit(camera.rayThrough(20, 50)));
    }
    CameraOptions wide;
    wide.fieldOfView = radiansFromDegrees(179);
    CHECK_THROWS_AS(Camera(wide, 10, 10), std::invalid_argument);
    CameraOptions nowhere;
    nowhere.elevation = std::nan("");
    CHECK_THROWS_AS(Camera(nowhere, 10, 10), std::invalid_argument);
}

TEST_CASE("a low light leaves one side of the cloth in the shadow of the other, a high one none") {
    const auto drape = makeDrape();
    CameraOptions options;
    options.elevation = radiansFromDegrees(60);
    const Camera camera(options, 60, 60);
    int lit = 0;
    int hidden = 0;
    const Imath::V3d low =
        vectorFromAzimuthElevation(radiansFromDegrees(90), radiansFromDegrees(12));
    for (int i = 0; i < 3600; ++i) {
        const auto point = drape->hit(camera.rayThrough(i % 60 + 0.5, i / 60 + 0.5));
        if (!point) continue;
        const Imath::V3d up(0, 1, 0);
        CHECK(drape->lightReaching(*point, up, 0.02) > 0.95);
        CHECK(drape->skyReaching(point->u, point->v, up) == 1);
        if ((point->frame.normal ^ low) <= 0.05) continue;
        const double share = drape->lightReaching(*point, low, 0.02);
        CHECK(share >= 0);
        CHECK(share <= 1);
        ++(share > 0.5 ? lit : hidden);
    }
    CHECK(lit > 200);
    CHECK(hidden > 50);
}

TEST_SUITE_END();
