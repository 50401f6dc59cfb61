// SPDX-License-Identifier: BSD-3-Clause
//
// Stacks of image files that are told apart by their names and first bytes: UTIA BTF, ATRIUM, names
// of the user's own, manifests.
#include "stages/read/btf_reader.h"
#include "stages/read/decode_image.h"
#include "stages/read/name_pattern.h"
#include "tests/support/reader_faults.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// One colour, 2 x 1 pixels.
void writeImage(const fs::path& file, float red, int width = 2, int height = 1) {
    fs::create_directories(file.parent_path());
    const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
    std::vector<float> pixels;
    for (int i = 0; i < width * height; ++i) pixels.insert(pixels.end(), {red, 0.5F, 0.25F});
    const auto output = OIIO::ImageOutput::create(file.string());
    REQUIRE(output->open(file.string(), spec));
    REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()));
    output->close();
}

float redOf(const BtfReader& reader, std::size_t pair) {
    return std::get<std::vector<float>>(reader.read(pair).rgb)[0];
}

void writeUtiaBtf(const fs::path& folder, const std::string& extension) {
    for (const int tv : {0, 15}) {
        for (const int pv : {0, 120}) {
            for (const int tl : {0, 15}) {
                for (const int pl : {0, 120}) {
                    writeImage(folder / fmt::format("tv{:03}_pv{:03}", tv, pv) /
                                   fmt::format("tl{:03}_pl{:03}_tv{:03}_pv{:03}.{}", tl, pl, tv, pv,
                                               extension),
                               0.25F);
                }
            }
        }
    }
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a UTIA BTF is known by its names: PNG is sRGB, EXR is CIE XYZ") {
    const TemporaryFolder folder;
    writeUtiaBtf(folder.path() / "png", "png");
    writeUtiaBtf(folder.path() / "exr", "EXR");
    const auto png = openBtf(folder.path() / "png");
    CHECK(png->description().format == "UTIA BTF");
    CHECK(png->description().colorSpace == "sRGB - Texture");
    CHECK(png->description().missingPairs().empty());
    CHECK(png->description().grid.pairCount() == 16);
    const auto exr = openBtf(folder.path() / "exr");
    CHECK(exr->description().colorSpace == "CIE XYZ-D65 - Scene-referred");
    CHECK(exr->description().notes[0].find("in 4 images light equals view") != std::string::npos);
}

TEST_CASE("a light that was moved out of the camera's way stands for its pair") {
    const TemporaryFolder folder;
    writeUtiaBtf(folder.path(), "exr");
    const fs::path view = folder.path() / "tv015_pv120";
    fs::rename(view / "tl015_pl120_tv015_pv120.exr", view / "tl015_pl130_tv015_pv120.exr");
    const auto reader = openBtf(folder.path());
    CHECK(reader->description().grid.pairCount() == 16);
    CHECK(reader->description().missingPairs().empty());
    CHECK(reader->description().duplicates.empty());
}

TEST_CASE("ATRIUM: 800 x 800 JPEGs, or Radiance pictures, which are turned upright") {
    const TemporaryFolder folder;
    writeImage(folder.path() / "jpg/00000 tl000 pl000 tv000 pv000.JPG", 0.5F, 800, 800);
    CHECK(openBtf(folder.path() / "jpg")->description().format == "ATRIUM");
    fs::create_directories(folder.path() / "hdr");
    writeFile(folder.path() / "hdr/00000 tl000 pl000 tv000 pv000.hdr", hdrBytes("+X 3 -Y 2", 6));
    const auto reader = openBtf(folder.path() / "hdr");
    CHECK(reader->description().format == "ATRIUM");
    CHECK(reader->description().colorSpace == "Linear Rec.709 (sRGB)");
    const EncodedImage image = reader->read(0);
    CHECK(image.width == 3);
    CHECK(image.height == 2);
    // The file's scanlines are the columns, from the left, each from the top.
    const std::vector<float> expected = {128, 130, 132, 129, 131, 133};
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(std::get<std::vector<float>>(image.rgb)[3 * i] * 256 == expected[i]);
    }
}

TEST_CASE("all eight ways that a picture can lie are turned upright") {
    // Size lines of Radiance: the major axis first; its sign says where scanlines begin.
    const std::vector<std::pair<const char*, std::vector<float>>> ways = {
        {"-Y 2 +X 3", {0, 1, 2, 3, 4, 5}}, {"-Y 2 -X 3", {2, 1, 0, 5, 4, 3}},
        {"+Y 2 -X 3", {5, 4, 3, 2, 1, 0}}, {"+Y 2 +X 3", {3, 4, 5, 0, 1, 2}},
        {"+X 3 -Y 2", {0, 2, 4, 1, 3, 5}}, {"-X 3 -Y 2", {4, 2, 0, 5, 3, 1}},
        {"-X 3 +Y 2", {5, 3, 1, 4, 2, 0}}, {"+X 3 +Y 2", {1, 3, 5, 0, 2, 4}}};
    for (const auto& [line, expected] : ways) {
        const std::string shown = line;  // clang 14's lambdas cannot take a binding.
        CAPTURE(shown);
        const std::string bytes = hdrBytes(line, 6);
        const EncodedImage image = decodeImage(bytes, "a.hdr");
        CHECK(image.width == 3);
        for (std::size_t i = 0; i < 6; ++i) {
            CHECK(std::get<std::vector<float>>(image.rgb)[3 * i] * 256 == 128 + expected[i]);
        }
    }
}

TEST_CASE("an image of 1.5 GB in a file of a kilobyte is refused before memory is taken") {
    const std::string bytes = hdrBytes("-Y 20000 +X 25000", 200);
    CHECK_THROWS_AS(decodeImage(bytes, "a.hdr"), std::runtime_error);
    CHECK_THROWS_AS(imageSize(bytes, "a.hdr"), std::runtime_error);
}

TEST_CASE(
    "names of the user's own are read by a pattern, a different set of lights a view included") {
    const TemporaryFolder folder;
    for (const int tv : {0, 30}) {
        for (const int tl : {0, 15, 45}) {
            writeImage(
                folder.path() / fmt::format("mine/view_{}_-90/light_{}.5_0.exr", tv, tl + tv),
                static_cast<float>(tl) / 64);
        }
    }
    writeImage(folder.path() / "mine/view_0_0/other.exr", 0);
    ReadOptions options;
    options.pattern = "view_{tv}_{pv}/light_{tl}_{pl}.exr";
    const auto reader = openBtf(folder.path(), options);
    const BtfDescription& d = reader->description();
    CHECK(d.format == "images by pattern");
    CHECK(d.grid.lights().size() == 5);  // 0.5 15.5 30.5 45.5 75.5
    CHECK(d.grid.views().size() == 2);
    CHECK(d.grid.views()[1].phi == doctest::Approx(1.5 * kPi));
    CHECK(d.imageCount() == 6);
    CHECK(d.missingPairs().empty());  // Nobody promised a grid.
    CHECK(redOf(*reader, d.grid.pairIndex(3, 0)) == 45.0F / 64);
    options.pattern = "light_{tl}.exr";
    CHECK_THROWS_AS(openBtf(folder.path(), options), std::invalid_argument);
    options.pattern = "x{tl}{pl}{tv}{pv}";
    CHECK_THROWS_AS(openBtf(folder.path(), options), std::runtime_error);
}

TEST_CASE("a pattern fits whole parts of a path, with any characters for *") {
    const NamePattern pattern("*_{tv}_{pv}/l{tl}p{pl}.*");
    const auto keys = pattern.match("top/any_view_30_-7.5/l15.25p270.EXR");
    REQUIRE(keys);
    CHECK(keys->tl == 15.25);
    CHECK(keys->pl == 270);
    CHECK(keys->tv == 30);
    CHECK(keys->pv == -7.5);
    CHECK_FALSE(pattern.match("top/any_30_0/l15p270"));
    CHECK_FALSE(pattern.match("any_30/0/l15p270.exr"));
    CHECK_FALSE(pattern.match("any_30_0/xl15p270.exr"));
    // Many stars cost no more than their number times the name's length.
    std::string stars = "{tl}{pl}{tv}{pv}";
    for (int i = 0; i < 30; ++i) stars += "*a";
    CHECK_FALSE(NamePattern(stars).match("1-2-3-4" + std::string(200, 'a') + "b"));
    CHECK(NamePattern(stars).match("1-2-3-4" + std::string(200, 'a')));
    for (const char* bad : {"{tl}{tl}{pl}{tv}{pv}", "{tl}{pl}{tv}", "{tl}{pl}{tv}{pv}{x}", ""}) {
        CHECK_THROWS_AS(NamePattern{bad}, std::invalid_argument);
    }
}

TEST_CASE("a manifest lists files and directions, any of them") {
    const TemporaryFolder folder;
    const fs::path manifest = folder.path() / "list.csv";
    for (int i = 0; i < 4; ++i) {
        writeImage(folder.path() / fmt::format("a, {}.exr", i), static_cast<float>(i));
    }
    const std::string rows =
        "file,theta_i,phi_i,theta_v,phi_v\r\n\"a, 0.exr\",10,0,20,0\n# a comment\n\n"
        "\"a, 1.exr\", 11.5, -90, 20, 0\n\"a, 2.exr\",12,0,40,1e1\n\"a, 3.exr\",95,0,40,0\n";
    writeFile(manifest, rows);
    const auto reader = openBtf(manifest);
    const BtfDescription& d = reader->description();
    CHECK(d.format == "images by manifest");
    CHECK(d.grid.lights().size() == 3);
    CHECK(d.grid.views().size() == 2);
    CHECK(d.belowHorizon == 1);
    CHECK(d.missingPairs().empty());
    CHECK(d.imageCount() == 3);
    CHECK(redOf(*reader, d.grid.pairIndex(1, 0)) == 1);
    CHECK(d.present[d.grid.pairIndex(1, 1)] == 0);

    const auto fault = [&](const std::string& text) {
        writeFile(manifest, text);
        return readFault(manifest);
    };
    CHECK(fault(rows + "a.exr,1,2,3\n").find("list.csv:8:") != std::string::npos);
    CHECK(fault(rows + "a.exr,1,2,3,x\n").find("list.csv:8:") != std::string::npos);
    CHECK(fault(rows + "none.exr,1,2,3,4\n").find("none.exr") != std::string::npos);
    CHECK(fault("file,theta_i,phi_i,theta_v,phi_v\n").find("lists no image") != std::string::npos);
}

TEST_CASE("a list whose directions make an absurd grid is refused before memory is taken") {
    const TemporaryFolder folder;
    std::string rows = "file,theta_i,phi_i,theta_v,phi_v\n";
    for (int i = 0; i < 5000; ++i) {
        rows += fmt::format("a.exr,{0},{0},{0},{0}\n", static_cast<double>(i) / 100);
    }
    writeFile(folder.path() / "list.csv", rows);
    CHECK(readFault(folder.path() / "list.csv").find("do not form a grid") != std::string::npos);
}

TEST_SUITE_END();
