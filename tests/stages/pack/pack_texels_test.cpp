// SPDX-License-Identifier: BSD-3-Clause
#include "stages/pack/pack_texels.h"

#include "abrdf/angular_grid.h"
#include "abrdf/packed_lines.h"
#include "abrdf/register_bytes.h"

#include <doctest/doctest.h>
#include <half.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

using namespace abrdf;

namespace {

constexpr int kLights = 5;
constexpr int kViews = 7;
constexpr std::size_t kPairs = kLights * kViews;

/// Values that tell where they belong, exactly in half.
std::vector<Rgb> valuesOf(std::size_t texels) {
    std::vector<Rgb> values;
    for (std::size_t t = 0; t < texels; ++t) {
        for (std::size_t p = 0; p < kPairs; ++p) {
            values.push_back({static_cast<float>(t), static_cast<float>(p), 1});
        }
    }
    return values;
}

/// Channel c (0 is B) of pixel (x, y) of a packed tile.
float channelOf(std::span<const char> packed, PixelType type, int width, int x, int y, int c) {
    const auto place = static_cast<std::size_t>((3 * y + c) * width + x) * bytesOf(type);
    if (type == PixelType::kFloat) {
        float value = 0;
        std::memcpy(&value, packed.data() + place, sizeof value);
        return value;
    }
    half value;
    std::memcpy(&value, packed.data() + place, sizeof value);
    return value;
}

/// All tiles of an atlas of these values, one after the other.
std::vector<std::vector<char>> packedTiles(const AtlasLayout& layout, PixelType type) {
    const TileOrder order = tileOrderOf(layout);
    const bool isAngular = layout.kind == AtlasKind::kAngular;
    const std::size_t texels = layout.texelCount();
    const std::vector<Rgb> rows = valuesOf(texels);
    std::vector<char> items(rows.size() * 3 * bytesOf(type));
    if (!isAngular) itemsFromTexels(rows, order, type, items);
    std::vector<std::vector<char>> tiles;
    for (std::size_t i = 0; i < order.tiles(); ++i) {
        const TileOrder::Tile tile = order.tile(i);
        std::vector<char>& packed =
            tiles.emplace_back(tile.cells() * (isAngular ? kPairs : texels) * 3 * bytesOf(type));
        if (!isAngular) {
            packSpatialTile(items, order.firstCell(i), layout, tile, type, packed);
            continue;
        }
        std::vector<Rgb> own;
        for (int y = tile.y; y < tile.y + tile.height; ++y) {
            const auto begin = rows.begin() + (y * layout.texelsWide + tile.x) * 35;
            own.insert(own.end(), begin, begin + tile.width * 35);
        }
        packAngularTile(own, layout, tile, type, packed);
    }
    return tiles;
}

PackOptions keep() {
    return {ColorConfig::load().transform("scene_linear", "scene_linear"), false};
}

void checkHalfs(const std::vector<Rgb>& colors, int registerBytes) {
    const RegisterLimit limit(registerBytes);
    std::vector<std::uint16_t> halfs(3 * colors.size());
    CHECK(halfsFrom(colors.data(), colors.size(), halfs.data()) == 0);
    std::vector<char> lines(halfs.size() * 2);
    const std::size_t plane = 2 * colors.size();
    CHECK(packLines(colors.data(), 1, colors.size(), PixelType::kHalf, {lines.data(), plane, 0}) ==
          0);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const std::uint16_t wanted[] = {half(colors[i].r).bits(), half(colors[i].g).bits(),
                                        half(colors[i].b).bits()};
        for (std::size_t c = 0; c < 3; ++c) {
            std::uint16_t packed = 0;
            std::memcpy(&packed, lines.data() + (2 - c) * plane + 2 * i, sizeof packed);
            wrong += halfs[3 * i + c] == wanted[c] && packed == wanted[c] ? 0U : 1U;
        }
    }
    CHECK(wrong == 0);

    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    const std::vector<Rgb> past = {{1, 65505, 1}, {kInfinite, 0, 0}, {-1e9F, 0, 0}, {1, 1, 1}};
    CHECK(halfsFrom(past.data(), past.size(), halfs.data()) == 3);
    CHECK(halfs[1] == half(65504.0F).bits());
    CHECK(halfs[3] == half(65504.0F).bits());
    CHECK(halfs[6] == half(-65504.0F).bits());
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("every value is packed where the layout says, in both layouts, on odd sizes") {
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        for (const auto& [wide, high] : {std::pair{3, 4}, {23, 29}}) {
            const AtlasLayout layout{kind, wide, high, kLights, kViews};
            const TileOrder order = tileOrderOf(layout);
            const int cellWidth = kind == AtlasKind::kAngular ? kViews : wide;
            const int cellHeight = kind == AtlasKind::kAngular ? kLights : high;
            for (const PixelType type : {PixelType::kHalf, PixelType::kFloat}) {
                const auto tiles = packedTiles(layout, type);
                std::size_t wrong = 0;
                for (std::size_t i = 0; i < tiles.size(); ++i) {
                    const TileOrder::Tile tile = order.tile(i);
                    const int width = tile.width * cellWidth;
                    for (int y = 0; y < tile.height * cellHeight; ++y) {
                        for (int x = 0; x < width; ++x) {
                            const AtlasSample s = layout.sampleFromPixel(
                                {tile.x * cellWidth + x, tile.y * cellHeight + y});
                            const Rgb is = {channelOf(tiles[i], type, width, x, y, 2),
                                            channelOf(tiles[i], type, width, x, y, 1),
                                            channelOf(tiles[i], type, width, x, y, 0)};
                            const Rgb wanted = {static_cast<float>(s.texelY * wide + s.texelX),
                                                static_cast<float>(s.light * kViews + s.view), 1};
                            wrong += is == wanted ? 0U : 1U;
                        }
                    }
                }
                CHECK(wrong == 0);
            }
        }
    }
}

TEST_CASE("halfs are those of Imath, for every kind of float; what none can hold is cut") {
    std::mt19937 random(7);
    std::vector<Rgb> colors;
    for (int i = 0; i < 100000; ++i) {
        const auto bits = static_cast<std::uint32_t>(random());
        float value = 0;
        std::memcpy(&value, &bits, sizeof value);
        // Small ones become subnormal halfs, and ties must round to even.
        if (i % 3 == 0) value = std::ldexp(static_cast<float>(random() % 8192), -30 + i % 16);
        if (!(std::fabs(value) <= 65504)) continue;
        colors.push_back({value, -value, value / 3});
    }
    for (const int bytes : {16, 32, 64}) checkHalfs(colors, bytes);
}

TEST_CASE("dividing by the cosine makes a Lambertian 1, and stays finite near grazing") {
    const AngularGrid grid({{0, 0}, {1, 0}, {1.3, 2}, {radiansFromDegrees(89.99), 0}}, {{0, 0}});
    std::vector<Rgb> texel;
    for (const Direction& light : grid.lights()) {
        const auto c = static_cast<float>(std::cos(light.theta));
        texel.push_back({c, c, c});
    }
    PackOptions options = keep();
    options.divideCosine = true;
    TexelFinisher(grid, options).finish(texel);
    for (std::size_t l = 0; l < 3; ++l) CHECK(texel[l].g == doctest::Approx(1).epsilon(1e-5));
    // Not by less than cos(89.9 degrees): 0.1.
    CHECK(texel[3].g == doctest::Approx(0.1).epsilon(1e-3));
}

TEST_CASE("without options values stay as they are; white is white in every output space") {
    const AngularGrid grid({{0, 0}}, {{0, 0}});
    std::vector<Rgb> texel = {{0.1F, 2, 3e5F}};
    TexelFinisher(grid, keep()).finish(texel);
    CHECK(texel[0] == Rgb{0.1F, 2, 3e5F});
    for (const char* space : {"ACEScg", "ACES2065-1", "Linear P3-D65", "Linear Rec.2020"}) {
        CAPTURE(space);
        texel[0] = {2, 2, 2};
        TexelFinisher(grid, {ColorConfig::load().transform("Linear Rec.709 (sRGB)", space), false})
            .finish(texel);
        CHECK(texel[0].r == doctest::Approx(2).epsilon(1e-4));
        CHECK(texel[0].g == doctest::Approx(2).epsilon(1e-4));
        CHECK(texel[0].b == doctest::Approx(2).epsilon(1e-4));
    }
}

TEST_SUITE_END();
