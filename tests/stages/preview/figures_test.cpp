// SPDX-License-Identifier: BSD-3-Clause
#include "color/heat_color.h"
#include "stages/preview/polar_plot.h"
#include "stages/preview/sheet.h"
#include "tests/support/synthetic_atlas.h"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

using namespace abrdf;

namespace {

Srgb8 pixelOf(const CodedPicture& picture, double x, double y) {
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
             static_cast<std::size_t>(x));
    return {static_cast<std::uint8_t>(picture.codes[i]),
            static_cast<std::uint8_t>(picture.codes[i + 1]),
            static_cast<std::uint8_t>(picture.codes[i + 2])};
}

SheetImages smallTable(int width, int height) {
    SheetImages row;
    row.title = "a method";
    row.caption = "mean ΔE 1";
    row.width = width;
    row.height = height;
    for (int i = 0; i < width * height; ++i) {
        const auto t = static_cast<float>(i) / static_cast<float>(width * height);
        row.measurement.push_back({t, 0.5F, 0});
        row.reconstruction.push_back({0, t, 0.5F});
        row.deltaE.push_back(30 * t);
    }
    return row;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("each value of a sheet stands in its three panels, in its own colour") {
    Sheet sheet;
    sheet.title =
        "A title that is much longer than three small panels would ever be wide, and more";
    sheet.rows = {smallTable(9, 4), smallTable(9, 4)};
    sheet.rows[1].reconstruction[5] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
    FigureColors colors;
    colors.exposure = 0.5;
    const CodedPicture picture = drawSheet(sheet, colors);
    for (std::size_t r = 0; r < 2; ++r) {
        const SheetImages& row = sheet.rows[r];
        const int scale = sheetScale(row);
        CHECK(scale > 10);
        const auto measured = shownColors(row.measurement, colors);
        const auto restored = shownColors(row.reconstruction, colors);
        const auto deltaE = deltaEColors(row.deltaE);
        for (int i = 0; i < 36; ++i) {
            const auto at = [&](int column) {
                const PlacePoint p = sheetPanel(sheet, r, column);
                return pixelOf(picture, p.x + (i % 9 + 0.5) * scale, p.y + (i / 9 + 0.5) * scale);
            };
            const auto k = static_cast<std::size_t>(i);
            CHECK(at(0) == measured[k]);
            CHECK(at(1) == restored[k]);
            CHECK(at(2) == deltaE[k]);
        }
    }
    CHECK(shownColors(sheet.rows[1].reconstruction, colors)[5] == figure::kUnknown);
    CHECK(shownColors(sheet.rows[0].measurement, colors)[0] == Srgb8{0, 64, 0});
    CHECK(deltaEColors(sheet.rows[0].deltaE)[35] == heatColor(1));
}

TEST_CASE("without a measurement a sheet has one column, and wrong lengths are refused") {
    Sheet sheet;
    sheet.rows = {smallTable(5, 5)};
    const int wide = drawSheet(sheet, {}).width;
    sheet.rows[0].measurement.clear();
    CHECK_THROWS_AS(drawSheet(sheet, {}), std::invalid_argument);
    sheet.rows[0].deltaE.clear();
    CHECK(drawSheet(sheet, {}).width < wide);
    sheet.rows[0].reconstruction.pop_back();
    CHECK_THROWS_AS(drawSheet(sheet, {}), std::invalid_argument);
    CHECK_THROWS_AS(drawSheet({}, {}), std::invalid_argument);
}

TEST_CASE("places on the hemisphere and views are inverses of one another") {
    for (const Direction view :
         {Direction{0, 0}, Direction{0.3, 1}, Direction{1.3, 4}, Direction{1.57, 6}}) {
        const auto back = viewOnHemisphere(placeOnHemisphere(view));
        REQUIRE(back);
        CHECK(back->theta == doctest::Approx(view.theta));
        CHECK(back->phi == doctest::Approx(view.phi));
    }
    CHECK_FALSE(viewOnHemisphere({0.8, 0.8}));
    CHECK(placeOnHemisphere({kPi / 2, kPi / 2}).y == doctest::Approx(1));
}

TEST_CASE("a polar plot shows a grey Lambertian as flat discs, and has rows for a reference") {
    const Atlas grey =
        syntheticAtlas(AngularGrid(ubo81Directions()), 1, 1, [](const LightAndView& p, int, int) {
            return lambertianWithGloss(p, {0.5F, 0.5F, 0.5F}, 0, 1);
        });
    PolarPlot plot;
    plot.title = "grey";
    plot.atlas = &grey;
    plot.lightThetas = {0, radiansFromDegrees(60)};
    const CodedPicture alone = drawPolarPlot(plot, {}, {});
    // The first disc's box begins at (46, 365) and is 330 wide: all of it 0.5 but the light's mark.
    for (int i = 0; i < 14; ++i) {
        CHECK(pixelOf(alone, 46 + 165 + 7 * i, 365 + 165 - 20 - 5 * i) == Srgb8{128, 128, 128});
    }
    plot.reference = &grey;
    const CodedPicture both = drawPolarPlot(plot, {}, {});
    CHECK(both.width == alone.width);
    CHECK(both.height > alone.height + 600);
    // Nothing differs: the last row is the colour of 0.
    CHECK(pixelOf(both, 46 + 165 + 40, both.height - 50 - 46 - 165) == heatColor(0));
}

TEST_SUITE_END();
