// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/contact_sheet.h"

#include "color/delta_e.h"
#include "color/heat_color.h"
#include "stages/measure/measures.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace abrdf {

namespace {

namespace fs = std::filesystem;

ContactSheet smallSheet(std::size_t lights, std::size_t views, std::size_t rows = 1) {
    ContactSheet sheet{"A title", lights, views, std::vector<Rgb>(lights * views), {}, 1};
    for (std::size_t i = 0; i < lights * views; ++i) {
        const float t = static_cast<float>(i + 1) / static_cast<float>(lights * views);
        sheet.measurement[i] = {t, 0.5F * t, 1 - t};
    }
    for (std::size_t row = 0; row < rows; ++row) {
        sheet.rows.push_back({"method", "Delta E 1", sheet.measurement});
        for (Rgb& color : sheet.rows.back().reconstruction) {
            color *= 0.9F - 0.2F * static_cast<float>(row);
        }
    }
    return sheet;
}

Canvas written(const fs::path& path, const ContactSheet& sheet) {
    writeContactSheet(path, sheet);
    const auto png = OIIO::ImageInput::open(path.string());
    REQUIRE(png);
    CHECK(png->spec().nchannels == 3);
    CHECK(png->spec().format == OIIO::TypeDesc::UINT8);
    CHECK(png->spec().get_string_attribute("DateTime").empty());
    Canvas canvas(png->spec().width, png->spec().height, {});
    REQUIRE(png->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, canvas.data()));
    return canvas;
}

std::string bytesOf(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Srgb8 shown(Rgb color, double exposure) {
    const auto code = [&](float value) {
        return static_cast<std::uint8_t>(std::lround(255 * srgbEncoded(exposure * value)));
    };
    return {code(color.r), code(color.g), code(color.b)};
}

/// Both corners of the square of a pair have `expected`.
void checkPair(const Canvas& canvas, const ContactSheet& sheet, std::size_t row, Panel panel,
               std::size_t pair, Srgb8 expected) {
    const int scale = panelScale(sheet);
    const Rectangle area = panelRectangle(sheet, row, panel);
    const int x = area.x + static_cast<int>(pair % sheet.views) * scale;
    const int y = area.y + static_cast<int>(pair / sheet.views) * scale;
    CHECK(canvas.at(x, y) == expected);
    CHECK(canvas.at(x + scale - 1, y + scale - 1) == expected);
}

void checkPanels(const Canvas& canvas, const ContactSheet& sheet) {
    for (std::size_t row = 0; row < sheet.rows.size(); ++row) {
        const auto& reconstruction = sheet.rows[row].reconstruction;
        const auto deltaE = deltaEMap(sheet.measurement, reconstruction, sheet.exposure);
        for (std::size_t pair = 0; pair < deltaE.size(); ++pair) {
            checkPair(canvas, sheet, row, Panel::kMeasurement, pair,
                      shown(sheet.measurement[pair], sheet.exposure));
            checkPair(canvas, sheet, row, Panel::kReconstruction, pair,
                      shown(reconstruction[pair], sheet.exposure));
            checkPair(canvas, sheet, row, Panel::kDeltaE, pair,
                      heatColor(deltaE[pair] / kSheetDeltaE));
        }
    }
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("every pair of every panel is a square of its sRGB value at its place") {
        const TemporaryFolder folder;
        auto sheet = smallSheet(3, 7, 2);
        sheet.exposure = 0.8;
        const Canvas canvas = written(folder.path() / "sheet.png", sheet);
        const Rectangle last = panelRectangle(sheet, 1, Panel::kDeltaE);
        CHECK(last.width == 7 * 47);
        CHECK(last.height == 3 * 47);
        CHECK(canvas.width() > last.right());
        CHECK(canvas.height() > last.bottom());
        checkPanels(canvas, sheet);
    }

    TEST_CASE("sheets of odd sizes are drawn: one pair, one light, one view, tall") {
        const TemporaryFolder folder;
        for (const auto& [lights, views] :
             {std::pair<std::size_t, std::size_t>{1, 1}, {7, 3}, {1, 50}, {50, 1}, {400, 2}}) {
            const auto sheet = smallSheet(lights, views);
            checkPanels(written(folder.path() / "sheet.png", sheet), sheet);
        }
    }

    TEST_CASE("panels are enlarged by the integer that makes them about 330 pixels") {
        CHECK(panelScale(smallSheet(81, 81)) == 4);
        CHECK(panelScale(smallSheet(288, 288)) == 1);
        CHECK(panelScale(smallSheet(400, 2)) == 1);
        CHECK(panelScale(smallSheet(1, 1)) == 330);
    }

    TEST_CASE("a long caption widens the sheet instead of being cut") {
        const TemporaryFolder folder;
        auto sheet = smallSheet(2, 2);
        const int width = written(folder.path() / "short.png", sheet).width();
        sheet.rows[0].caption = std::string(150, 'M');
        CHECK(written(folder.path() / "long.png", sheet).width() > width + 500);
    }

    TEST_CASE("values that are not finite are grey") {
        const TemporaryFolder folder;
        auto sheet = smallSheet(2, 2);
        sheet.rows[0].reconstruction[3].g = std::numeric_limits<float>::quiet_NaN();
        const Canvas canvas = written(folder.path() / "sheet.png", sheet);
        checkPair(canvas, sheet, 0, Panel::kReconstruction, 3, {128, 128, 128});
        checkPair(canvas, sheet, 0, Panel::kDeltaE, 3, {128, 128, 128});
    }

    TEST_CASE("images of texels stand below their method, each texel a square") {
        const TemporaryFolder folder;
        auto sheet = smallSheet(2, 3, 2);
        sheet.imageWidth = 3;
        sheet.imageHeight = 2;
        for (SheetRow& row : sheet.rows) {
            for (int i = 0; i < 2; ++i) {
                row.images.push_back({"an image", std::vector<Rgb>(6), std::vector<Rgb>(6)});
                row.images.back().measurement[4] = {0.1F, 0.2F, 0.3F};
                row.images.back().reconstruction[4] = row.reconstruction[2];
            }
        }
        const Canvas canvas = written(folder.path() / "sheet.png", sheet);
        checkPanels(canvas, sheet);
        for (std::size_t row = 0; row < 2; ++row) {
            for (std::size_t image = 0; image < 2; ++image) {
                const auto texel4 = [&](Panel panel) {
                    const Rectangle area = imageRectangle(sheet, row, image, panel);
                    return canvas.at(area.x + area.width / 2, area.y + area.height - 1);
                };
                CHECK(texel4(Panel::kMeasurement) == shown({0.1F, 0.2F, 0.3F}, 1));
                CHECK(texel4(Panel::kReconstruction) ==
                      shown(sheet.rows[row].reconstruction[2], 1));
            }
        }
        CHECK(imageRectangle(sheet, 0, 1, Panel::kDeltaE).bottom() <
              panelRectangle(sheet, 1, Panel::kDeltaE).y);
        sheet.rows[1].images.pop_back();
        CHECK_THROWS_AS(writeContactSheet(folder.path() / "b.png", sheet), std::invalid_argument);
    }
    TEST_CASE("the same sheet gives the same bytes") {
        const TemporaryFolder folder;
        writeContactSheet(folder.path() / "a.png", smallSheet(5, 4, 2));
        writeContactSheet(folder.path() / "b.png", smallSheet(5, 4, 2));
        CHECK(bytesOf(folder.path() / "a.png") == bytesOf(folder.path() / "b.png"));
    }

    TEST_CASE("a folder that does not exist is an error that names the file") {
        const TemporaryFolder folder;
        const fs::path path = folder.path() / "missing" / "sheet.png";
        CHECK_THROWS_WITH_AS(writeContactSheet(path, smallSheet(2, 2)),
                             doctest::Contains(path.c_str()), std::runtime_error);
    }

    TEST_CASE("tables of the wrong size are refused, and a sheet without rows") {
        auto sheet = smallSheet(2, 2);
        sheet.rows[0].reconstruction.pop_back();
        CHECK_THROWS_WITH_AS(writeContactSheet("unused.png", sheet),
                             doctest::Contains("'method' has 3 values"), std::invalid_argument);
        sheet.rows.clear();
        CHECK_THROWS_AS(writeContactSheet("unused.png", sheet), std::invalid_argument);
        CHECK_THROWS_AS(writeContactSheet("unused.png", ContactSheet{}), std::invalid_argument);
    }
}

}  // namespace abrdf
