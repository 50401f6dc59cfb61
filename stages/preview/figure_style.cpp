// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/figure_style.h"

#include "color/heat_color.h"

#include <fmt/format.h>

#include <algorithm>

namespace abrdf {

std::vector<Srgb8> shownColors(std::span<const Rgb> colors, const FigureColors& how) {
    std::vector<Rgb> codes(colors.begin(), colors.end());
    for (Rgb& c : codes) c *= static_cast<float>(how.exposure);
    how.toDisplay.apply(codes);
    std::vector<Srgb8> shown(codes.size(), figure::kUnknown);
    const auto code = [](float v) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0F, 1.0F)));
    };
    for (std::size_t i = 0; i < codes.size(); ++i) {
        if (!isFinite(colors[i]) || !isFinite(codes[i])) continue;
        shown[i] = {code(codes[i].r), code(codes[i].g), code(codes[i].b)};
    }
    return shown;
}

std::vector<Srgb8> deltaEColors(std::span<const float> values) {
    std::vector<Srgb8> colors;
    colors.reserve(values.size());
    for (const float v : values)
        colors.push_back(heatColor(static_cast<double>(v) / kFigureDeltaE));
    return colors;
}

void drawDeltaEBar(Drawing& drawing, double x, double y, double width) {
    constexpr double kHeight = 14;
    constexpr int kTicks = 4;
    drawing.rectangle(x - 1, y - 1, width + 2, kHeight + 2, figure::kFrame);
    for (int i = 0; i < static_cast<int>(width); ++i) {
        drawing.rectangle(x + i, y, 1, kHeight, heatColor((i + 0.5) / width));
    }
    for (int tick = 0; tick <= kTicks; ++tick) {
        const std::string number =
            fmt::format("{}{:g}", tick == kTicks ? "≥ " : "", kFigureDeltaE * tick / kTicks);
        drawing.text(x + width * tick / kTicks, y + kHeight + 17, number, figure::kNote,
                     tick == 0        ? TextAlign::kLeft
                     : tick == kTicks ? TextAlign::kRight
                                      : TextAlign::kCenter);
    }
}

}  // namespace abrdf
