// SPDX-License-Identifier: BSD-3-Clause
#include "stages/pack/pack_texels.h"

#include "abrdf/for_each_texel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace abrdf;

namespace {

constexpr int kWide = 3;
constexpr int kHigh = 4;
constexpr int kLights = 5;
constexpr int kViews = 7;

AtlasLayout layoutOf(AtlasKind kind) {
    return {kind, kWide, kHigh, kLights, kViews};
}

/// Texels [first, first + count); each value tells where it belongs.
AbrdfTile tileOf(std::size_t first, std::size_t count) {
    AbrdfTile tile(count, kLights * kViews);
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t p = 0; p < tile.valuesPerTexel(); ++p) {
            tile[t][p] = {static_cast<float>(first + t), static_cast<float>(p), 1};
        }
    }
    return tile;
}

Rgb at(const AtlasBlock& block, int x, int y) {
    return block.pixels[static_cast<std::size_t>((y - block.y) * block.width + x)];
}

PackOptions keep() {
    return {ColorConfig::load().transform("scene_linear", "scene_linear"), false};
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("every value is packed where the layout says, in both layouts") {
    const AbrdfTile tile = tileOf(0, kWide * kHigh);
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        const AtlasLayout layout = layoutOf(kind);
        const AtlasBlock block = kind == AtlasKind::kAngular ? packAngular(tile, layout, 0, kHigh)
                                                             : packSpatial(tile, layout);
        CHECK(block.width == layout.width());
        CHECK(block.height == layout.height());
        REQUIRE(block.pixels.size() == 12 * 35);
        for (int y = 0; y < layout.height(); ++y) {
            for (int x = 0; x < layout.width(); ++x) {
                const AtlasSample s = layout.sampleFromPixel({x, y});
                CHECK(at(block, x, y) == Rgb{static_cast<float>(s.texelY * kWide + s.texelX),
                                             static_cast<float>(s.light * kViews + s.view), 1});
            }
        }
    }
}

TEST_CASE("an angular atlas packed row by row is the one packed at once") {
    const AtlasLayout layout = layoutOf(AtlasKind::kAngular);
    const AtlasBlock whole = packAngular(tileOf(0, kWide * kHigh), layout, 0, kHigh);
    std::vector<Rgb> pixels;
    for (const auto& [row, rows] : {std::pair{0, 1}, {1, 2}, {3, 1}}) {
        const AtlasBlock block = packAngular(
            tileOf(static_cast<std::size_t>(row * kWide), static_cast<std::size_t>(rows * kWide)),
            layout, row, rows);
        CHECK(block.y == row * kLights);
        pixels.insert(pixels.end(), block.pixels.begin(), block.pixels.end());
    }
    CHECK(pixels == whole.pixels);
}

TEST_CASE("dividing by the cosine makes a Lambertian 1, and stays finite near grazing") {
    const AngularGrid grid({{0, 0}, {1, 0}, {1.3, 2}, {radiansFromDegrees(89.99), 0}}, {{0, 0}});
    AbrdfTile tile(1, 4);
    for (std::size_t l = 0; l < 4; ++l) {
        const auto c = static_cast<float>(std::cos(grid.lights()[l].theta));
        tile[0][l] = {c, c, c};
    }
    PackOptions options = keep();
    options.divideCosine = true;
    finishTexels(tile, grid, options);
    for (std::size_t l = 0; l < 3; ++l) CHECK(tile[0][l].g == doctest::Approx(1).epsilon(1e-5));
    // Not by less than cos(89.9 degrees): 0.1.
    CHECK(tile[0][3].g == doctest::Approx(0.1).epsilon(1e-3));
}

TEST_CASE("without options values stay as they are; white is white in every output space") {
    const AngularGrid grid({{0, 0}}, {{0, 0}});
    AbrdfTile tile(1, 1);
    tile[0][0] = {0.1F, 2, 3e5F};
    finishTexels(tile, grid, keep());
    CHECK(tile[0][0] == Rgb{0.1F, 2, 3e5F});
    for (const char* space : {"ACEScg", "ACES2065-1", "Linear P3-D65", "Linear Rec.2020"}) {
        CAPTURE(space);
        tile[0][0] = {2, 2, 2};
        finishTexels(tile, grid,
                     {ColorConfig::load().transform("Linear Rec.709 (sRGB)", space), false});
        CHECK(tile[0][0].r == doctest::Approx(2).epsilon(1e-4));
        CHECK(tile[0][0].g == doctest::Approx(2).epsilon(1e-4));
        CHECK(tile[0][0].b == doctest::Approx(2).epsilon(1e-4));
    }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("threads");

TEST_CASE("packing gives the same bits on 1, 2 and 7 threads") {
    const AngularGrid grid(regularDirections(1, kLights), regularDirections(1, kViews));
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        std::vector<Rgb> first;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            AbrdfTile tile = tileOf(0, kWide * kHigh);
            finishTexels(tile, grid,
                         {ColorConfig::load().transform("Linear Rec.709 (sRGB)", "ACEScg"), true});
            const AtlasBlock block = kind == AtlasKind::kAngular
                                         ? packAngular(tile, layoutOf(kind), 0, kHigh)
                                         : packSpatial(tile, layoutOf(kind));
            if (first.empty()) first = block.pixels;
            CHECK(block.pixels == first);
        }
    }
}

TEST_SUITE_END();
