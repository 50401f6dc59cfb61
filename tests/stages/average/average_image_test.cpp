// SPDX-License-Identifier: BSD-3-Clause
#include "stages/average/average_image.h"

#include "abrdf/random.h"
#include "color/delta_e.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

using namespace abrdf;

namespace {

Linearizer identity() {
    return Linearizer(ColorConfig::load().transform("Raw", "Raw"));
}
Linearizer fromSrgb() {
    return Linearizer(ColorConfig::load().transform("sRGB - Texture", "Linear Rec.709 (sRGB)"));
}

EncodedImage ramp(int width, int height) {
    std::vector<float> values;
    for (int i = 0; i < width * height; ++i) {
        for (const float scale : {1.0F, 2.0F, 3.0F})
            values.push_back(scale * static_cast<float>(i));
    }
    return {width, height, values};
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("texels that do not divide the image conserve its mean") {
    const EncodedImage image = ramp(13, 7);
    for (const auto& [w, h] : {std::pair{1, 1}, {13, 7}, {5, 3}, {2, 7}, {12, 6}}) {
        std::vector<Rgb> texels(static_cast<std::size_t>(w * h));
        CHECK(averageImage(image, identity(), w, h, texels) == 0);
        double sum = 0;
        for (const Rgb& t : texels) sum += static_cast<double>(t.g);
        CHECK(sum / (w * h) == doctest::Approx(2 * 45.0).epsilon(1e-6));
    }
}

TEST_CASE("every texel of a full map is its own pixel") {
    const EncodedImage image = ramp(4, 3);
    std::vector<Rgb> texels(12);
    averageImage(image, identity(), 4, 3, texels);
    CHECK(texels[7] == Rgb{7, 14, 21});
}

TEST_CASE("a pixel that a border cuts counts by its parts") {
    const EncodedImage image{3, 1, std::vector<float>{0, 0, 0, 6, 6, 6, 12, 12, 12}};
    std::vector<Rgb> texels(2);
    averageImage(image, identity(), 2, 1, texels);
    CHECK(texels[0].r == doctest::Approx(2));
    CHECK(texels[1].r == doctest::Approx(10));
}

TEST_CASE("NaN, infinite and negative pixels are counted and kept out") {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const EncodedImage image{
        5, 1, std::vector<float>{1, 1, 1, std::nanf(""), 1, 1, 1, kInf, 1, 1, 1, -1e30F, 3, 3, 3}};
    std::vector<Rgb> one(1);
    CHECK(averageImage(image, identity(), 1, 1, one) == 3);
    CHECK(one[0] == Rgb{2, 2, 2});
    std::vector<Rgb> all(5);
    averageImage(image, identity(), 5, 1, all);
    CHECK_FALSE(isFinite(all[1]));
}

TEST_CASE("eight-bit sRGB is averaged in linear light") {
    const EncodedImage image{2, 1, std::vector<std::uint8_t>{0, 0, 0, 255, 128, 255}};
    std::vector<Rgb> texel(1);
    averageImage(image, fromSrgb(), 1, 1, texel);
    CHECK(texel[0].r == doctest::Approx(0.5));
    CHECK(static_cast<double>(texel[0].g) ==
          doctest::Approx(0.5 * linearFromSrgb(128.0 / 255)).epsilon(1e-5));
}

TEST_CASE("more texels than pixels are refused") {
    std::vector<Rgb> texels(20);
    CHECK_THROWS_AS(averageImage(ramp(4, 3), identity(), 5, 3, texels), std::invalid_argument);
}

TEST_CASE("a change of primaries after the average is one before it, a pixel at a time") {
    const ColorConfig config =
        ColorConfig::load(std::filesystem::path(ABRDF_SOURCE_DIR) / "color/config.ocio");
    std::vector<std::uint8_t> codes;
    std::vector<Rgb> encoded;
    Random random(3);
    for (int i = 0; i < 19 * 11 * 3; ++i) {
        codes.push_back(static_cast<std::uint8_t>(random.below(256)));
    }
    for (std::size_t i = 0; i < codes.size(); i += 3) {
        encoded.push_back({static_cast<float>(codes[i]) / 255,
                           static_cast<float>(codes[i + 1]) / 255,
                           static_cast<float>(codes[i + 2]) / 255});
    }
    const EncodedImage image{19, 11, codes};
    // The second has negative parts: single texels are cut at 0, an average is cut once.
    for (const auto& [from, to] : {std::pair("srgb_tx", "ACEScg"), {"ACEScg", "lin_rec709"}}) {
        const ColorTransform transform = config.transform(from, to);
        const Linearizer linearizer(transform);
        REQUIRE(linearizer.table() != nullptr);
        CHECK(linearizer.table()->matrix);
        std::vector<Rgb> pixels = encoded;
        transform.apply(pixels);
        std::vector<Rgb> texels(pixels.size());
        CHECK(averageImage(image, linearizer, 19, 11, texels) == 0);
        double sum = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            CHECK(std::abs(texels[i].r - std::max(0.0F, pixels[i].r)) < 2e-6);
            CHECK(std::abs(texels[i].b - std::max(0.0F, pixels[i].b)) < 2e-6);
            sum += static_cast<double>(pixels[i].g);
        }
        averageImage(image, linearizer, 1, 1, std::span(texels).first(1));
        CHECK(static_cast<double>(texels[0].g) ==
              doctest::Approx(sum / static_cast<double>(pixels.size())).epsilon(1e-6));
    }
}

TEST_SUITE_END();
