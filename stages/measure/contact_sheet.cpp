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

int imageScale(const ContactSheet& sheet) {
    return std::max(1, kPanel / std::max({1, sheet.imageWidth, sheet.imageHeight}));
}

bool hasImages(const ContactSheet& sheet) {
    return !sheet.rows.empty() && !sheet.rows.front().images.empty();
}

int columnWidth(const ContactSheet& sheet) {
    const int images = hasImages(sheet) ? imageScale(sheet) * sheet.imageWidth : 0;
    return std::max({kNarrowest, panelScale(sheet) * static_cast<int>(sheet.views), images});
}

int columnX(const ContactSheet& sheet, int column) {
    return kMargin + column * (columnWidth(sheet) + kGap);
}

int rowY(const ContactSheet& sheet, std::size_t row) {
    int height = panelScale(sheet) * static_cast<int>(sheet.lights) + kCaptionHeight;
    if (hasImages(sheet)) {
        height += static_cast<int>(sheet.rows.front().images.size()) *
                  (imageScale(sheet) * sheet.imageHeight + kCaptionHeight);
    }
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

/// Colours row by row, `width` a row, each a square of `area`.
void drawPanel(Canvas& canvas, const Rectangle& area, int width, const std::vector<Srgb8>& colors) {
    const int scale = area.width / width;
    canvas.fill({area.x - 1, area.y - 1, area.width + 2, area.height + 2}, kFrame);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const int y = static_cast<int>(i) / width;
        const int x = static_cast<int>(i) % width;
        canvas.fill({area.x + x * scale, area.y + y * scale, scale, scale}, colors[i]);
    }
}

/// rectangle(panel): where the three pictures stand.
template <typename RectangleOf>
void drawPanels(Canvas& canvas, double exposure, int width, const std::vector<Rgb>& measurement,
                const std::vector<Rgb>& reconstruction, const RectangleOf& rectangle) {
    drawPanel(canvas, rectangle(Panel::kMeasurement), width, displayColors(measurement, exposure));
    drawPanel(canvas, rectangle(Panel::kReconstruction), width,
              displayColors(reconstruction, exposure));
    drawPanel(canvas, rectangle(Panel::kDeltaE), width,
              heatColors(deltaEMap(measurement, reconstruction, exposure)));
}

void drawRow(Canvas& canvas, const ContactSheet& sheet, std::size_t row) {
    const SheetRow& method = sheet.rows[row];
    drawPanels(canvas, sheet.exposure, static_cast<int>(sheet.views), sheet.measurement,
               method.reconstruction,
               [&](Panel panel) { return panelRectangle(sheet, row, panel); });
    const int baseline = panelRectangle(sheet, row, Panel::kMeasurement).bottom() + 24;
    drawLabel(canvas, kMargin, baseline, method.title, kRowTitle);
    drawLabel(canvas, canvas.width() - kMargin, baseline, method.caption, kCaption, Align::kRight);
    for (std::size_t i = 0; i < method.images.size(); ++i) {
        const auto rectangle = [&](Panel panel) { return imageRectangle(sheet, row, i, panel); };
        drawPanels(canvas, sheet.exposure, sheet.imageWidth, method.images[i].measurement,
                   method.images[i].reconstruction, rectangle);
        drawLabel(canvas, kMargin, rectangle(Panel::kMeasurement).bottom() + 24,
                  method.images[i].title, kCaption);
    }
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
    for (const SheetRow& row : sheet.rows) {
        check(row.reconstruction, "'" + row.title + "'");
        const auto texels = static_cast<std::size_t>(sheet.imageWidth * sheet.imageHeight);
        const bool isSound =
            row.images.size() == sheet.rows.front().images.size() &&
            std::ranges::all_of(row.images, [&](const SheetImage& image) {
                return image.measurement.size() == texels && image.reconstruction.size() == texels;
            });
        if (isSound) continue;
        throw std::invalid_argument(
            fmt::format("contact sheet: the images of '{}' are not {} of {} x {} texels", row.title,
                        sheet.rows.front().images.size(), sheet.imageWidth, sheet.imageHeight));
    }
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

Rectangle imageRectangle(const ContactSheet& sheet, std::size_t row, std::size_t image,
                         Panel panel) {
    const int scale = imageScale(sheet);
    const int height = scale * sheet.imageHeight;
    return {columnX(sheet, static_cast<int>(panel)),
            panelRectangle(sheet, row, panel).bottom() + kCaptionHeight +
                static_cast<int>(image) * (height + kCaptionHeight),
            scale * sheet.imageWidth, height};
}

void writeContactSheet(const std::filesystem::path& path, const ContactSheet& sheet) {
    checkSheet(sheet);
    writeWholeFile(path, pngBytes(drawnSheet(sheet)));
}

}  // namespace abrdf
