// SPDX-License-Identifier: BSD-3-Clause
#include "stages/average/linearizer.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("the table for eight-bit codes says what the transform says pixel by pixel") {
    std::vector<std::uint8_t> codes;
    std::vector<float> values;
    for (int i = 0; i < 256; ++i) {
        for (const int code : {i, 255 - i, i / 2}) {
            codes.push_back(static_cast<std::uint8_t>(code));
            values.push_back(static_cast<float>(code) / 255.0F);
        }
    }
    std::vector<Rgb> fromCodes(256);
    std::vector<Rgb> fromValues(256);
    const Linearizer fromSrgb(
        ColorConfig::load().transform("sRGB - Texture", "Linear Rec.709 (sRGB)"));
    const CodeTable* table = fromSrgb.table();
    REQUIRE(table != nullptr);
    fromSrgb.linearize({256, 1, codes}, 0, fromCodes);
    fromSrgb.linearize({256, 1, values}, 0, fromValues);
    for (std::size_t i = 0; i < 256; ++i) {
        CHECK(fromCodes[i].r == doctest::Approx(fromValues[i].r).epsilon(1e-6));
        CHECK(fromCodes[i].b == doctest::Approx(fromValues[i].b).epsilon(1e-6));
        CHECK(table->curves[1][codes[3 * i + 1]] ==
              doctest::Approx(static_cast<double>(fromValues[i].g)).epsilon(1e-6));
    }
}

TEST_CASE("what is no curve and matrix goes pixel by pixel") {
    const ColorConfig config =
        ColorConfig::load(std::filesystem::path(ABRDF_SOURCE_DIR) / "color/config.ocio");
    // ACEScct is not 0 at code 0.
    CHECK(Linearizer(config.transform("ACEScct", "ACES2065-1")).table() == nullptr);
    CHECK(Linearizer(config.displayTransform("ACEScg", {})).table() == nullptr);
}

TEST_SUITE_END();
