// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr int kPanel = 330;      // Images are enlarged up to this.
constexpr int kNarrowest = 280;  // Room for the headings.
constexpr int kMargin = 40;
constexpr int kGap = 20;
constexpr int kTop = 128;     // Title, note and headings.
constexpr int kCaption = 56;  // Below each row.
constexpr int kLegend = 66;

bool compares(const Sheet& sheet) {
    return !sheet.rows.front().measurement.empty();
}

int columnWidth(const Sheet& sheet) {
    int width = kNarrowest;
    for (const SheetImages& row : sheet.rows) width = std::max(width, row.width * sheetScale(row));
    return width;
}

int rowHeight(const SheetImages& row) {
    return row.height * sheetScale(row) + kCaption;
}

void check(const Sheet& sheet) {
    if (sheet.rows.empty()) throw std::invalid_argument("a sheet needs at least one row");
    for (const SheetImages& row : sheet.rows) {
        const auto count =
            static_cast<std::size_t>(row.width) * static_cast<std::size_t>(row.height);
        const bool fits = count > 0 && row.reconstruction.size() == count &&
                          (row.measurement.size() == count || row.measurement.empty()) &&
                          row.deltaE.size() == row.measurement.size() &&
                          row.measurement.empty() == sheet.rows.front().measurement.empty();
        if (!fits) {
            throw std::invalid_argument(fmt::format(
                "the sheet's row '{}' needs {} values in each of its images", row.title, count));
        }
    }
}

void drawPanel(Drawing& drawing, const Sheet& sheet, std::size_t index, int column,
               const std::vector<Srgb8>& colors) {
    const SheetImages& row = sheet.rows[index];
    const PlacePoint at = sheetPanel(sheet, index, column);
    const int width = row.width * sheetScale(row);
    const int height = row.height * sheetScale(row);
    drawing.rectangle(at.x - 1, at.y - 1, width + 2, height + 2, figure::kFrame);
    drawing.image(at.x, at.y, width, height, row.width, row.height, colors);
}

}  // namespace

int sheetScale(const SheetImages& row) {
    return std::max(1, kPanel / std::max({row.width, row.height, 1}));
}

PlacePoint sheetPanel(const Sheet& sheet, std::size_t row, int column) {
    int y = kTop;
    for (std::size_t i = 0; i < row; ++i) y += rowHeight(sheet.rows[i]);
    return {static_cast<double>(kMargin + column * (columnWidth(sheet) + kGap)),
            static_cast<double>(y)};
}

CodedPicture drawSheet(const Sheet& sheet, const FigureColors& colors) {
    check(sheet);
    const int columns = compares(sheet) ? 3 : 1;
    const int column = columnWidth(sheet);
    Drawing ruler(1, 1, {});
    double content = columns * column + (columns - 1) * kGap;
    content = std::max({content, ruler.textWidth(sheet.title, figure::kTitle),
                        ruler.textWidth(sheet.note, figure::kNote),
                        ruler.textWidth(colors.note, figure::kNote)});
    int height = kTop + (columns == 3 ? kLegend : 16);
    for (const SheetImages& row : sheet.rows) {
        height += rowHeight(row);
        content = std::max(content, ruler.textWidth(row.title, figure::kHeading) + 2 * kGap +
                                        ruler.textWidth(row.caption, figure::kText));
    }
    const int width = 2 * kMargin + static_cast<int>(std::ceil(content));
    Drawing drawing(width, height, figure::kBackground);
    drawing.text(kMargin, 50, sheet.title, figure::kTitle);
    drawing.text(kMargin, 74, fmt::format("{}", sheet.note), figure::kNote);
    drawing.text(kMargin, 92, colors.note, figure::kNote);
    constexpr std::array kHeadings{"Full measurement", "Reconstruction", "ΔE (CIE 1976)"};
    for (int i = 0; i < columns; ++i) {
        drawing.text(sheetPanel(sheet, 0, i).x, kTop - 12,
                     columns == 1 ? "Values" : kHeadings[static_cast<std::size_t>(i)],
                     figure::kText);
    }
    for (std::size_t i = 0; i < sheet.rows.size(); ++i) {
        const SheetImages& row = sheet.rows[i];
        if (columns == 3) {
            drawPanel(drawing, sheet, i, 0, shownColors(row.measurement, colors));
            drawPanel(drawing, sheet, i, 2, deltaEColors(row.deltaE));
        }
        drawPanel(drawing, sheet, i, columns == 3 ? 1 : 0, shownColors(row.reconstruction, colors));
        const double baseline = sheetPanel(sheet, i, 0).y + row.height * sheetScale(row) + 26;
        drawing.text(kMargin, baseline, row.title, figure::kHeading);
        drawing.text(width - kMargin, baseline, row.caption, figure::kText, TextAlign::kRight);
    }
    if (columns == 3) {
        drawDeltaEBar(drawing, sheetPanel(sheet, 0, 2).x, height - kLegend, column);
    }
    return drawing.picture();
}

}  // namespace abrdf
