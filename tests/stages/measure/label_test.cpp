// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/label.h"

#include <doctest/doctest.h>

#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr Srgb8 kBlack{0, 0, 0};
constexpr Srgb8 kWhite{255, 255, 255};

/// Columns from the first to the last that has ink; {0, 0} where there is none.
struct Ink {
    int begin = 0, end = 0;
};

Ink inkOf(const Canvas& canvas) {
    Ink ink;
    for (int x = 0; x < canvas.width(); ++x) {
        for (int y = 0; y < canvas.height(); ++y) {
            if (canvas.at(x, y) == kBlack) continue;
            if (ink.end == 0) ink.begin = x;
            ink.end = x + 1;
        }
    }
    return ink;
}

Ink inkOfLabel(Align align) {
    Canvas canvas(300, 40, kBlack);
    drawLabel(canvas, 150, 30, "Delta E", {16, Weight::kRegular, kWhite}, align);
    return inkOf(canvas);
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("a label begins, is centred or ends at its place") {
        const int width = labelWidth("Delta E", {16, Weight::kRegular, kWhite});
        CHECK(width > 40);
        CHECK(width < 90);
        CHECK(inkOfLabel(Align::kLeft).begin >= 150);
        CHECK(inkOfLabel(Align::kLeft).begin <= 153);
        CHECK(inkOfLabel(Align::kCenter).begin < 150 - width / 4);
        CHECK(inkOfLabel(Align::kCenter).end > 150 + width / 4);
        CHECK(inkOfLabel(Align::kRight).end <= 151);
        CHECK(inkOfLabel(Align::kRight).end >= 147);
    }

    TEST_CASE("characters beyond ASCII take one place each, and line ends none of a second line") {
        const LabelStyle style{16, Weight::kBold, kWhite};
        CHECK(labelWidth("\u0394", style) == labelWidth("?", style));
        CHECK(labelWidth("\U0001F600", style) == labelWidth("?", style));
        CHECK(labelWidth("a\nb", style) == labelWidth("a b", style));
        CHECK(labelWidth("", style) == 0);
    }

    TEST_CASE("without a font the message names the package to install") {
        CHECK_THROWS_WITH_AS(findFont(std::array<std::string, 2>{"/nowhere/x.ttf", "NoSuchFont"}),
                             doctest::Contains("fonts-dejavu-core"), std::runtime_error);
    }
}

}  // namespace abrdf
