// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/contact_sheet.h"

#include "abrdf/output_file.h"
#include "color/delta_e.h"
#include "color/heat_color.h"
#include "stages/measure/label.h"
#include "stages/measure/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

// The design, in pixels.
constexpr int kPanel = 330;      // Pictures are enlarged up to this.
constexpr int kNarrowest = 280;  // A column of small pictures leaves room for the headings.
constexpr int kMargin = 40;
constexpr int kGap = 20;  // Between columns.
constexpr int kTitleHeight = 52;
constexpr int kHeadingHeight = 30;
constexpr int kCaptionHeight = 60;  // A row's text and the space below it.
constexpr int kLegendHeight = 40;

constexpr Srgb8 kBackground{34, 34, 34};
constexpr Srgb8 kFrame{84, 84, 84};
constexpr Srgb8 kUnknown{128, 128, 128};  // A value that is not finite.
constexpr LabelStyle kTitle{24, Weight::kBold, {242, 242, 242}};
constexpr LabelStyle kHeading{16, Weight::kRegular, {200, 200, 200}};
constexpr LabelStyle kRowTitle{16, Weight::kBold, {230, 230, 230}};
constexpr LabelStyle kCaption{16, Weight::kRegular, {230, 230, 230}};
constexpr LabelStyle kNote{14, Weight::kRegular, {170, 170, 170}};

constexpr std::array kHeadings{"Full measurement", "Reconstruction", "Delta E (CIE 1976)"};

int columnWidth(const ContactSheet& sheet) {
    return std::max(kNarrowest, panelScale(sheet) * static_cast<int>(sheet.views));
}

int columnX(const ContactSheet& sheet, int column) {
    return kMargin + column * (columnWidth(sheet) + kGap);
}

int rowY(const ContactSheet& sheet, std::size_t row) {
    const int height = panelScale(sheet) * static_cast<int>(sheet.lights) + kCaptionHeight;
    return kMargin + kTitleHeight + kHeadingHeight + static_cast<int>(row) * height;
}

// Long texts widen the sheet: they are never cut.
int contentWidth(const ContactSheet& sheet) {
    int width = 3 * columnWidth(sheet) + 2 * kGap;
    width = std::max(width, labelWidth(sheet.title, kTitle));
    for (const SheetRow& row : sheet.rows) {
        width = std::max(
            width, labelWidth(row.title, kRowTitle) + 2 * kGap + labelWidth(row.caption, kCaption));
    }
    return width;
}

Srgb8 displayColor(Rgb color, double exposure) {
    if (!isFinite(color)) return kUnknown;
    const auto code = [&](float value) {
        return static_cast<std::uint8_t>(std::lround(255 * srgbEncoded(exposure * value)));
    };
    return {code(color.r), code(color.g), code(color.b)};
}

std::vector<Srgb8> displayColors(const std::vector<Rgb>& colors, double exposure) {
    std::vector<Srgb8> shown(colors.size());
    std::transform(colors.begin(), colors.end(), shown.begin(),
                   [&](Rgb color) { return displayColor(color, exposure); });
    return shown;
}

std::vector<Srgb8> heatColors(const std::vector<float>& deltaE) {
    std::vector<Srgb8> shown(deltaE.size());
    std::transform(deltaE.begin(), deltaE.end(), shown.begin(),
                   [](float value) { return heatColor(value / kSheetDeltaE); });
    return shown;
}

void drawPanel(Canvas& canvas, const ContactSheet& sheet, std::size_t row, Panel panel,
               const std::vector<Srgb8>& colors) {
    const Rectangle area = panelRectangle(sheet, row, panel);
    const int scale = panelScale(sheet);
    canvas.fill({area.x - 1, area.y - 1, area.width + 2, area.height + 2}, kFrame);
    for (std::size_t pair = 0; pair < colors.size(); ++pair) {
        const int light = static_cast<int>(pair / sheet.views);
        const int view = static_cast<int>(pair % sheet.views);
        canvas.fill({area.x + view * scale, area.y + light * scale, scale, scale}, colors[pair]);
    }
}

void drawRow(Canvas& canvas, const ContactSheet& sheet, std::size_t row) {
    const SheetRow& method = sheet.rows[row];
    drawPanel(canvas, sheet, row, Panel::kMeasurement,
              displayColors(sheet.measurement, sheet.exposure));
    drawPanel(canvas, sheet, row, Panel::kReconstruction,
              displayColors(method.reconstruction, sheet.exposure));
    drawPanel(canvas, sheet, row, Panel::kDeltaE,
              heatColors(deltaEMap(sheet.measurement, method.reconstruction, sheet.exposure)));

    const int baseline = panelRectangle(sheet, row, Panel::kMeasurement).bottom() + 24;
    drawLabel(canvas, kMargin, baseline, method.title, kRowTitle);
    drawLabel(canvas, canvas.width() - kMargin, baseline, method.caption, kCaption, Align::kRight);
}

void drawLegend(Canvas& canvas, const ContactSheet& sheet, int y) {
    constexpr int kBarHeight = 14;
    constexpr int kTicks = 4;
    const int baseline = y + kBarHeight + 20;
    const Rectangle bar{columnX(sheet, 2), y, columnWidth(sheet), kBarHeight};
    canvas.fill({bar.x - 1, bar.y - 1, bar.width + 2, bar.height + 2}, kFrame);
    for (int i = 0; i < bar.width; ++i) {
        canvas.fill({bar.x + i, bar.y, 1, bar.height}, heatColor((i + 0.5) / bar.width));
    }
    for (int tick = 0; tick <= kTicks; ++tick) {
        const int x = bar.x + bar.width * tick / kTicks;
        const auto number =
            fmt::format("{}{:g}", tick == kTicks ? ">= " : "", kSheetDeltaE * tick / kTicks);
        const Align align = tick == 0        ? Align::kLeft
                            : tick == kTicks ? Align::kRight
                                             : Align::kCenter;
        drawLabel(canvas, x, baseline, number, kNote, align);
    }
    drawLabel(canvas, kMargin, y + kBarHeight - 1,
              fmt::format("{} lights (rows) x {} views (columns), shown as sRGB at exposure {:.4g}",
                          sheet.lights, sheet.views, sheet.exposure),
              kNote);
}

void checkSheet(const ContactSheet& sheet) {
    const std::size_t pairs = sheet.lights * sheet.views;
    const auto check = [&](const std::vector<Rgb>& table, const std::string& name) {
        if (pairs != 0 && table.size() == pairs) return;
        throw std::invalid_argument(
            fmt::format("contact sheet: {} has {} values, expected {} lights x {} views", name,
                        table.size(), sheet.lights, sheet.views));
    };
    check(sheet.measurement, "the measurement");
    for (const SheetRow& row : sheet.rows) check(row.reconstruction, "'" + row.title + "'");
    if (sheet.rows.empty()) {
        throw std::invalid_argument("contact sheet: there is no reconstruction to show");
    }
}

Canvas drawnSheet(const ContactSheet& sheet) {
    const int legendY = rowY(sheet, sheet.rows.size());
    Canvas canvas(contentWidth(sheet) + 2 * kMargin, legendY + kLegendHeight + kMargin,
                  kBackground);
    drawLabel(canvas, kMargin, kMargin + 20, sheet.title, kTitle);
    for (int column = 0; column < 3; ++column) {
        drawLabel(canvas, columnX(sheet, column), kMargin + kTitleHeight + 18,
                  kHeadings[static_cast<std::size_t>(column)], kHeading);
    }
    for (std::size_t row = 0; row < sheet.rows.size(); ++row) drawRow(canvas, sheet, row);
    drawLegend(canvas, sheet, legendY);
    return canvas;
}

}  // namespace

int panelScale(const ContactSheet& sheet) {
    return std::max(1, kPanel / static_cast<int>(std::max(sheet.lights, sheet.views)));
}

Rectangle panelRectangle(const ContactSheet& sheet, std::size_t row, Panel panel) {
    const int scale = panelScale(sheet);
    return {columnX(sheet, static_cast<int>(panel)), rowY(sheet, row),
            scale * static_cast<int>(sheet.views), scale * static_cast<int>(sheet.lights)};
}

void writeContactSheet(const std::filesystem::path& path, const ContactSheet& sheet) {
    checkSheet(sheet);
    writeWholeFile(path, pngBytes(drawnSheet(sheet)));
}

}  // namespace abrdf
