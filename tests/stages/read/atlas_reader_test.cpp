// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/atlas_reader.h"

#include "stages/write/atlas_writer.h"
#include "tests/support/fault_of.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

AtlasHeader ubo81Header() {
    AtlasHeader header;
    header.grid = AngularGrid(ubo81Directions());
    header.layout = {AtlasKind::kAngular, 1, 1, 81, 81};
    header.interopId = "lin_rec709_scene";
    return header;
}

/// 2 + theta_i - theta_v / 2 in every channel.
std::vector<Rgb> linearPixels(const AngularGrid& grid) {
    std::vector<Rgb> pixels;
    for (std::size_t i = 0; i < grid.pairCount(); ++i) {
        const LightAndView p = grid.pair(i);
        const auto value = static_cast<float>(2 + p.light.theta - p.view.theta / 2);
        pixels.push_back({value, value, value});
    }
    return pixels;
}

void writeAtlasFile(const fs::path& path, const AtlasHeader& header,
                    const std::vector<Rgb>& pixels) {
    AtlasWriter writer(path, header, {PixelType::kFloat, Compression::kZip, false, {}});
    writer.writeRows(0, header.layout.height(), pixels);
    writer.finish({});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("between an atlas's directions its values are interpolated, past the last one held") {
    const TemporaryFolder folder;
    const AtlasHeader header = ubo81Header();
    writeAtlasFile(folder.path() / "a.exr", header, linearPixels(header.grid));
    const Atlas atlas = readAtlas(folder.path() / "a.exr");
    for (int k = 0; k < 200; ++k) {
        const Direction light = {radiansFromDegrees(0.37 * k), 0.9 * k};
        const Direction view = {radiansFromDegrees(75 - 0.37 * k), 2.3 * k};
        const Rgb c = lookUp(atlas, light, view, 0, 0);
        CHECK(static_cast<double>(c.g) ==
              doctest::Approx(2 + light.theta - view.theta / 2).epsilon(1e-5));
    }
    CHECK(lookUp(atlas, {radiansFromDegrees(89), 1}, {0, 0}, 0, 0).r ==
          doctest::Approx(lookUp(atlas, {radiansFromDegrees(75), 1}, {0, 0}, 0, 0).r));
    for (const auto& [x, y] : {std::pair{-1, 0}, {0, -1}, {1, 0}, {0, 1}}) {
        CHECK_THROWS_AS(lookUp(atlas, {}, {}, x, y), std::out_of_range);
    }
}

TEST_CASE("an atlas that was cut off anywhere is an error that names it") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "cut.exr";
    const AtlasHeader header = ubo81Header();
    writeAtlasFile(path, header, linearPixels(header.grid));
    const std::string whole = bytesOf(path);
    for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{200},
                                   std::size_t{1500}, whole.size() / 2, whole.size() - 1}) {
        CAPTURE(size);
        std::ofstream(path, std::ios::binary) << whole.substr(0, size);
        CHECK(faultOf([&] { readAtlas(path); }).find("cut.exr") != std::string::npos);
    }
    CHECK(faultOf([&] { readAtlas(folder.path() / "none.exr"); }).find("none.exr") !=
          std::string::npos);
}

TEST_CASE("an OpenEXR file of another program is no atlas") {
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "other.exr").string();
    const OIIO::ImageSpec spec(4, 3, 3, OIIO::TypeDesc::HALF);
    const auto output = OIIO::ImageOutput::create(path);
    REQUIRE(output->open(path, spec));
    const std::vector<float> values(36, 0.5F);
    output->write_image(OIIO::TypeDesc::FLOAT, values.data());
    output->close();
    CHECK_FALSE(isAtlas(path));
    CHECK_FALSE(isAtlas(folder.path()));
    CHECK_FALSE(isAtlas(folder.path() / "absent"));
    CHECK(faultOf([&] { readAtlas(path); }).find("other.exr") != std::string::npos);
}

TEST_CASE("an atlas in memory needs all its pixels") {
    CHECK_THROWS_AS(Atlas(ubo81Header(), std::vector<Rgb>(6560)), std::invalid_argument);
}

TEST_CASE("an atlas that finds the disk full is an error, and the old one stays") {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "a.exr";
    std::ofstream(path) << "old";
    const AtlasHeader header = ubo81Header();
    std::vector<Rgb> noise;
    for (std::uint32_t i = 0; i < 6561; ++i) {
        const float value = static_cast<float>(i * 2654435761U) / 4e9F;
        noise.push_back({value, 1 - value, value * value});
    }
    std::string fault;
    {
        const FileSizeLimit limit(8192);
        fault = faultOf([&] { writeAtlasFile(path, header, noise); });
    }
    CHECK(fault.find("a.exr") != std::string::npos);
    CHECK(bytesOf(path) == "old");
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_SUITE_END();
