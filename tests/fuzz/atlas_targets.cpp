// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/atlas_reader.h"
#include "stages/read/atlas_tiles.h"
#include "stages/read/environment_reader.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/targets.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace abrdf {

namespace {

/// What promises only std::runtime_error.
template <typename Action>
void mayFail(const Action& action) {
    try {
        action();
    } catch (const std::runtime_error&) {
    }
}

void runAtlas(std::span<const char> bytes) {
    const std::filesystem::path path = fuzzFile("fuzz_atlas.exr", bytes);
    mayFail([&] {
        if (!isAtlas(path)) return;
        readAtlasHeader(path);
    });
    mayFail([&] {
        const Atlas atlas = readAtlas(path);
        const AtlasLayout& layout = atlas.header().layout;
        lookUp(atlas, {0.5, 1}, {1, 4}, layout.texelsWide - 1, layout.texelsHigh - 1);
        meanOverTexels(atlas);
    });
    mayFail([&] {
        const AtlasTiles tiles(path);
        const std::size_t count = tiles.order().tiles();
        for (std::size_t i = 0; i < count; i += 1 + count / 5) {
            mayFail([&] { static_cast<void>(tiles.raw(i)); });
            mayFail([&] { static_cast<void>(tiles.pixels(i)); });
        }
    });
}

/// Directions of any kind: on rings, scattered, twice the same, and now and then impossible.
std::vector<Direction> someDirections(FuzzBytes& bytes) {
    const int kind = bytes.between(0, 7);
    if (kind == 0) return regularDirections(bytes.between(1, 5), bytes.between(1, 9));
    std::vector<Direction> directions;
    for (int i = bytes.between(1, 24); i > 0; --i) {
        directions.push_back(kind == 1 ? Direction{bytes.number(), bytes.number()}
                                       : Direction{bytes.angle(kPi / 2), bytes.angle(2 * kPi)});
    }
    return directions;
}

void runLookUp(std::span<const char> data) {
    FuzzBytes bytes(data);
    AtlasHeader header;
    header.layout.kind = bytes.between(0, 1) == 0 ? AtlasKind::kAngular : AtlasKind::kSpatial;
    header.layout.texelsWide = bytes.between(1, 3);
    header.layout.texelsHigh = bytes.between(1, 3);
    try {
        const auto lights = someDirections(bytes);
        header.grid = AngularGrid(lights, someDirections(bytes));
    } catch (const std::invalid_argument&) {
        return;
    }
    header.layout.lights = static_cast<int>(header.grid.lights().size());
    header.layout.views = static_cast<int>(header.grid.views().size());
    const float value = bytes.light();
    const std::vector<Rgb> pixels(header.layout.texelCount() * header.grid.pairCount(),
                                  {value, 0, 1});
    const Atlas atlas(header, pixels);
    // The same everywhere is the same between.
    const auto check = [&](Direction light, Direction view) {
        const Rgb found = lookUp(atlas, light, view, 0, header.layout.texelsHigh - 1);
        fuzzCheck(std::abs(found.b - 1) < 1e-4F && found.g == 0, "weights sum to 1");
        // But for the rounding of the smallest floats, and of the largest.
        const bool isRounded = value < 1e-30F || value > 1e38F;
        fuzzCheck(isRounded || found.r <= 1.001F * value, "no look-up exceeds what is stored");
    };
    check(header.grid.lights().back(), header.grid.views().front());
    for (int i = 0; i < 4; ++i) {
        const Direction light{bytes.angle(kPi / 2), bytes.angle(2 * kPi)};
        check(light, {bytes.angle(kPi / 2), bytes.angle(2 * kPi)});
    }
    while (!bytes.isEmpty()) {
        const Direction light{bytes.number(), bytes.number()};
        const Direction view{bytes.number(), bytes.number()};
        const int x = bytes.between(-1, 3);
        try {
            lookUp(atlas, light, view, x, bytes.between(-1, 3));
        } catch (const std::out_of_range&) {
        }
    }
}

/// The first byte says which format the name promises.
void runEnvironment(std::span<const char> bytes) {
    if (bytes.empty()) return;
    constexpr std::array kNames = {"sky.hdr", "sky.exr", "sky.png"};
    const auto choice = static_cast<unsigned char>(bytes[0]) % kNames.size();
    mayFail([&] { readEnvironment(fuzzFile(kNames[choice], bytes.subspan(1))); });
}

std::string atlasBytes(const AngularGrid& grid, int width, int height) {
    const TemporaryFolder folder;
    writeAtlas(folder.path() / "a.exr",
               syntheticAtlas(grid, width, height, [](const LightAndView& pair, int x, int y) {
                   return lambertianWithGloss(pair, {0.2F, 0.1F * static_cast<float>(x), 0.5F},
                                              0.1 * y, 0.3);
               }));
    return bytesOf(folder.path() / "a.exr");
}

std::vector<std::string> atlasSeeds() {
    return {atlasBytes(AngularGrid({{0, 0}}, {{0, 0}, {0.5, 1}}), 1, 1),
            atlasBytes(AngularGrid(regularDirections(2, 3)), 3, 2)};
}

std::vector<std::string> lookUpSeeds() {
    ByteWriter rings;
    for (const int byte : {0, 1, 2, 0, 3, 7, 0, 2, 4}) rings.put(static_cast<std::uint8_t>(byte));
    rings.put(0.5F);
    for (int i = 0; i < 16; ++i) rings.put(static_cast<std::uint8_t>(16 * i));
    for (const float angle : {0.3F, 1.0F, 1.2F, -3.0F}) rings.put(angle);
    rings.put(std::uint8_t{1}).put(std::uint8_t{1});
    for (int i = 0; i < 4; ++i) rings.put(std::numeric_limits<float>::quiet_NaN());
    std::string scattered;
    for (int i = 0; i < 120; ++i) scattered += static_cast<char>(2 + 37 * i);
    return {rings.bytes(), scattered};
}

std::vector<std::string> environmentSeeds() {
    const TemporaryFolder folder;
    SyntheticBtf btf;
    btf.grid = AngularGrid({{0, 0}}, {{0, 0}});
    btf.width = 4;
    btf.height = 2;
    btf.value = [](const LightAndView&, int x, int) { return Rgb{1, 2, static_cast<float>(x)}; };
    writeSyntheticBtf(folder.path(), btf);
    return {std::string(1, '\0') + hdrBytes("-Y 2 +X 3", 6),
            '\1' + bytesOf(folder.path() / syntheticFile(btf, 0))};
}

constexpr std::array kTargets{
    FuzzTarget{"atlas", runAtlas, atlasSeeds},
    FuzzTarget{"look_up", runLookUp, lookUpSeeds},
    FuzzTarget{"environment", runEnvironment, environmentSeeds},
};

}  // namespace

std::span<const FuzzTarget> atlasTargets() {
    return kTargets;
}

}  // namespace abrdf
