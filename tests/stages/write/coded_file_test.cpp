// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/coded_file.h"

#include "stages/write/icc_profile.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <lcms2.h>

#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

CodedPicture ramp(int bits, const char* display) {
    CodedPicture picture;
    picture.width = 17;
    picture.height = 3;
    picture.bits = bits;
    const int most = bits == 16 ? 65535 : 255;
    for (int i = 0; i < 17 * 3 * 3; ++i) {
        picture.codes.push_back(static_cast<std::uint16_t>(i * most / (17 * 3 * 3)));
    }
    picture.encoding = knownDisplay({display});
    picture.notes = {{"Software", "abrdf"}, {"Comment", "a -> b"}};
    return picture;
}

/// Names of the chunks of a PNG file before its first IDAT, in their order, with their data.
std::vector<std::pair<std::string, std::string>> chunksOf(const std::string& png) {
    std::vector<std::pair<std::string, std::string>> chunks;
    for (std::size_t at = 8; at + 12 <= png.size();) {
        std::size_t size = 0;
        for (std::size_t i = 0; i < 4; ++i)
            size = size << 8U | static_cast<unsigned char>(png[at + i]);
        const std::string name = png.substr(at + 4, 4);
        if (name == "IDAT") break;
        chunks.emplace_back(name, png.substr(at + 8, size));
        at += 12 + size;
    }
    return chunks;
}

std::string dataOf(const std::string& png, const std::string& name) {
    for (const auto& [chunk, data] : chunksOf(png)) {
        if (chunk == name) return data.empty() ? "empty" : data;
    }
    return {};
}

std::vector<std::uint16_t> readBack(const std::string& bytes, const char* name) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    const bool wide = spec.format == OIIO::TypeDesc::UINT16;
    std::vector<std::uint16_t> codes(
        static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, codes.data()));
    if (!wide) {
        for (std::uint16_t& code : codes) code = static_cast<std::uint16_t>(code / 257);
    }
    return codes;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a PNG holds the codes that it was given, of 8 bits and of 16, with and without alpha") {
    for (const int bits : {8, 16}) {
        CodedPicture picture = ramp(bits, "sRGB");
        CHECK(readBack(pngBytes(picture), "a.png") == picture.codes);
        picture.channels = 4;
        picture.codes.resize(17 * 3 * 4, static_cast<std::uint16_t>(bits == 16 ? 65535 : 255));
        for (std::size_t i = 3; i < picture.codes.size(); i += 4) {
            picture.codes[i] = static_cast<std::uint16_t>(bits == 16 ? 65535 : 255);
        }
        CHECK(readBack(pngBytes(picture), "a.png") == picture.codes);
    }
}

TEST_CASE("each encoding is stated in the chunks that readers know it by, and nothing else") {
    const std::string srgb = pngBytes(ramp(8, "sRGB"));
    CHECK(dataOf(srgb, "sRGB").size() == 1);
    CHECK(dataOf(srgb, "gAMA").size() == 4);
    CHECK(dataOf(srgb, "cICP").empty());
    CHECK(dataOf(srgb, "iCCP").empty());

    const std::string p3 = pngBytes(ramp(8, "Display P3"));
    CHECK(dataOf(p3, "cICP") == std::string{'\x0C', '\x0D', '\0', '\1'});
    CHECK(dataOf(p3, "iCCP").substr(0, 10) == "Display P3");
    CHECK(dataOf(p3, "sRGB").empty());

    const std::string pq = pngBytes(ramp(16, "Rec.2100-PQ"));
    CHECK(dataOf(pq, "cICP") == std::string{'\x09', '\x10', '\0', '\1'});
    CHECK(dataOf(pq, "iCCP").empty());
    // cICP comes before all that describes colour otherwise, as the third edition of PNG asks.
    CHECK(chunksOf(pq)[1].first == "cICP");

    const std::string video = pngBytes(ramp(8, "Rec.1886"));
    CHECK(dataOf(video, "cICP").empty());
    CHECK_FALSE(dataOf(video, "iCCP").empty());

    const std::string unknown = pngBytes(ramp(8, "no such display"));
    for (const char* chunk : {"sRGB", "gAMA", "cHRM", "cICP", "iCCP"}) {
        CHECK(dataOf(unknown, chunk).empty());
    }
    CHECK(dataOf(unknown, "tEXt").substr(0, 8) == "Software");
    for (const auto& [name, data] : chunksOf(srgb)) CHECK(name != "tIME");
}

TEST_CASE("a profile decodes as its display does, and is the same at any time") {
    for (const char* display : {"sRGB", "Display P3", "Rec.1886", "p3d65_display"}) {
        CAPTURE(display);
        const DisplayEncoding encoding = *knownDisplay({display});
        const std::string bytes = iccProfile(encoding);
        CHECK(bytes == iccProfile(encoding));
        CHECK(bytes.substr(24, 4) == std::string{'\x07', '\xD0', '\0', '\1'});
        cmsHPROFILE profile =
            cmsOpenProfileFromMem(bytes.data(), static_cast<cmsUInt32Number>(bytes.size()));
        REQUIRE(profile != nullptr);
        const auto* curve = static_cast<cmsToneCurve*>(cmsReadTag(profile, cmsSigGreenTRCTag));
        REQUIRE(curve != nullptr);
        for (const float code : {0.02F, 0.3F, 0.8F}) {
            const double c = static_cast<double>(code);
            const double light = encoding.curve == DisplayCurve::kPower
                                     ? std::pow(c, encoding.gamma)
                                 : c <= 0.04045 ? c / 12.92
                                                : std::pow((c + 0.055) / 1.055, 2.4);
            CHECK(static_cast<double>(cmsEvalToneCurveFloat(curve, code)) ==
                  doctest::Approx(light).epsilon(1e-3));
        }
        cmsCloseProfile(profile);
    }
    CHECK(iccProfile(*knownDisplay({"Rec.2100-PQ"})).empty());
}

TEST_CASE("a JPEG carries its ICC profile, and refuses what it cannot hold") {
    const std::string jpeg = jpegBytes(ramp(8, "Display P3"), 95);
    CHECK(jpeg.find("ICC_PROFILE") != std::string::npos);
    CHECK(readBack(jpeg, "a.jpg").size() == 17 * 3 * 3);
    CHECK_THROWS_AS(jpegBytes(ramp(16, "sRGB"), 95), std::invalid_argument);
    CHECK_THROWS_AS(jpegBytes(ramp(8, "Rec.2100-PQ"), 95), std::invalid_argument);
}

TEST_SUITE_END();
