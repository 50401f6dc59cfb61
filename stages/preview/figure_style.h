// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/color_config.h"
#include "stages/preview/drawing.h"

#include <array>
#include <cmath>

namespace abrdf {

/// The look that sheets and polar plots share: a neutral dark surround, as colours ask for.
namespace figure {

inline constexpr Srgb8 kBackground{34, 34, 34};
inline constexpr Srgb8 kFrame{84, 84, 84};
inline constexpr Srgb8 kFaint{66, 66, 66};
inline constexpr Srgb8 kUnknown{128, 128, 128};  ///< A value that is not finite.
inline constexpr Srgb8 kFirst{255, 176, 82};     ///< The curve of the atlas.
inline constexpr Srgb8 kSecond{122, 194, 255};   ///< The curve of the measurement.
inline const TextStyle kTitle{24, true, {242, 242, 242}};
inline const TextStyle kHeading{16, true, {230, 230, 230}};
inline const TextStyle kText{15, false, {215, 215, 215}};
inline const TextStyle kNote{13, false, {175, 175, 175}};

}  // namespace figure

/// How a figure shows scene-linear colours; all at one exposure.
struct FigureColors {
    ColorTransform toDisplay;  ///< From the space of the values to codes 0 .. 1.
    double exposure = 1;       ///< Factor on the values, > 0.
    std::string note;          ///< Display, view and exposure in words.
};

/// The codes of colours; grey where one is not finite.
std::vector<Srgb8> shownColors(std::span<const Rgb> colors, const FigureColors& how);

/// A bar of the colours of Delta E with its numbers, `width` pixels wide.
void drawDeltaEBar(Drawing& drawing, double x, double y, double width);

/// Delta E of the last colour of the bar.
inline constexpr double kFigureDeltaE = 20;

/// The colours of Delta E values.
std::vector<Srgb8> deltaEColors(std::span<const float> values);

}  // namespace abrdf
