// SPDX-License-Identifier: BSD-3-Clause
#include "stages/align/shift_image.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

using namespace abrdf;

namespace {

constexpr int kWidth = 5;
constexpr int kHeight = 4;

/// Texel (x, y) holds 10 y + x.
std::vector<Rgb> numbered() {
    std::vector<Rgb> image;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const auto value = static_cast<float>(10 * y + x);
            image.push_back({value, 2 * value, 1});
        }
    }
    return image;
}

struct Shifted {
    std::vector<Rgb> image;
    std::size_t outside;

    Rgb at(int x, int y) const { return image[static_cast<std::size_t>(y * kWidth + x)]; }
};

Shifted shifted(const std::vector<Rgb>& image, Shift shift, Edges edges) {
    Shifted result{std::vector<Rgb>(image.size()), 0};
    result.outside = shiftImage(image, kWidth, kHeight, shift, edges, result.image);
    return result;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a shift by whole texels moves a periodic image round") {
    const Shifted s = shifted(numbered(), {2, -1}, Edges::kPeriodic);
    CHECK(s.outside == 0);
    CHECK(s.at(0, 1).r == 2);       // From (2, 0).
    CHECK(s.at(4, 0).r == 30 + 1);  // From (6, -1), which is (1, 3).
    CHECK(shifted(s.image, {-2, 1}, Edges::kPeriodic).image == numbered());
}

TEST_CASE("between texels it is linear in both ways") {
    const Shifted s = shifted(numbered(), {0.25, 0.5}, Edges::kPeriodic);
    CHECK(s.at(1, 1).r == doctest::Approx(10 * 1.5 + 1.25));
    CHECK(s.at(1, 1).g == doctest::Approx(2 * (10 * 1.5 + 1.25)));
    CHECK(s.at(4, 3).b == 1);
}

TEST_CASE("what lies outside a cropped image is NaN and counted") {
    const Shifted s = shifted(numbered(), {1.5, 0}, Edges::kCropped);
    CHECK(s.outside == 2 * kHeight);
    CHECK(s.at(2, 1).r == doctest::Approx(13.5));
    CHECK_FALSE(isFinite(s.at(3, 0)));
    CHECK_FALSE(isFinite(s.at(4, 3)));
}

TEST_CASE("what is higher stands further away from the viewer's side") {
    // Seen from +x at 45 degrees, what lies one texel up is rectified one texel towards -x.
    const Shift fromRight = parallax(1, {kPi / 4, 0});
    CHECK(fromRight.x == doctest::Approx(-1));
    CHECK(fromRight.y == doctest::Approx(0));
    // Azimuths turn towards +y, image up; rows go down.
    const Shift fromAbove = parallax(2, {kPi / 4, kPi / 2});
    CHECK(fromAbove.x == doctest::Approx(0).epsilon(1e-9));
    CHECK(fromAbove.y == doctest::Approx(2));
    CHECK(std::isfinite(parallax(1, {kPi / 2, 1}).x));
}

TEST_SUITE_END();
