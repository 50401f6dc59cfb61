// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/encode_picture.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace abrdf;

namespace {

Picture filled(Rgb color, float alpha) {
    Picture picture(64, 64);
    for (std::size_t i = 0; i < picture.count(); ++i) {
        picture.color[i] = alpha * color;
        picture.alpha[i] = alpha;
    }
    return picture;
}

double meanOf(const CodedPicture& picture, std::size_t channel) {
    double sum = 0;
    const auto step = static_cast<std::size_t>(picture.channels);
    for (std::size_t i = channel; i < picture.codes.size(); i += step) sum += picture.codes[i];
    return sum * static_cast<double>(step) / static_cast<double>(picture.codes.size());
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("dithered codes are right on average, and exact at 0 and 1") {
    for (const float value : {0.1F, 0.3337F, 0.5F, 0.99F}) {
        double sum = 0;
        for (std::size_t pixel = 0; pixel < 20'000; ++pixel) {
            const std::uint16_t code = ditheredCode(value, 8, pixel, 1);
            CHECK(std::abs(code - 255 * static_cast<double>(value)) < 1);
            sum += code;
        }
        CHECK(sum / 20'000 == doctest::Approx(255 * static_cast<double>(value)).epsilon(1e-3));
    }
    for (std::size_t pixel = 0; pixel < 1000; ++pixel) {
        CHECK(ditheredCode(0, 8, pixel, 0) == 0);
        CHECK(ditheredCode(1, 8, pixel, 0) == 255);
        CHECK(ditheredCode(1, 16, pixel, 2) == 65535);
        CHECK(ditheredCode(7, 16, pixel, 2) == 65535);
        CHECK(ditheredCode(-1, 8, pixel, 2) == 0);
    }
}

TEST_CASE("exposure comes before the display, the background after the exposure") {
    EncodeOptions options;
    options.exposure = 2;
    options.background = Rgb{0.2F, 0.2F, 0.2F};
    const CodedPicture coded = encodePicture(filled({0.3F, 0.1F, 0}, 0.5F), {}, options);
    CHECK(coded.channels == 3);
    CHECK(meanOf(coded, 0) == doctest::Approx(255 * (0.3 + 0.1)).epsilon(1e-3));
    CHECK(meanOf(coded, 1) == doctest::Approx(255 * (0.1 + 0.1)).epsilon(2e-3));
    CHECK(meanOf(coded, 2) == doctest::Approx(255 * 0.1).epsilon(5e-3));
}

TEST_CASE("without dither every pixel of one colour has one code, the nearest") {
    EncodeOptions options;
    options.dither = false;
    options.background = Rgb{};
    const CodedPicture coded = encodePicture(filled({0.3F, 0.5F, 0.7F}, 1), {}, options);
    for (std::size_t i = 0; i < coded.codes.size(); i += 3) {
        CHECK(coded.codes[i] == 77);
        CHECK(coded.codes[i + 2] == 179);
    }
}

TEST_CASE("without a background colours are those behind the alpha") {
    EncodeOptions options;
    options.bits = 16;
    const CodedPicture coded = encodePicture(filled({0.6F, 0.4F, 0.2F}, 0.25F), {}, options);
    CHECK(coded.channels == 4);
    CHECK(meanOf(coded, 0) == doctest::Approx(65535 * 0.6).epsilon(1e-4));
    CHECK(meanOf(coded, 3) == doctest::Approx(65535 * 0.25).epsilon(1e-4));
}

TEST_CASE("depths and exposures that are none are refused") {
    EncodeOptions options;
    options.bits = 12;
    CHECK_THROWS_AS(encodePicture(filled({}, 1), {}, options), std::invalid_argument);
    options.bits = 8;
    for (const double exposure : {0.0, -1.0, std::nan("")}) {
        options.exposure = exposure;
        CHECK_THROWS_AS(encodePicture(filled({}, 1), {}, options), std::invalid_argument);
    }
}

TEST_SUITE_END();
