// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/measure/canvas.h"

#include <span>
#include <string>

namespace abrdf {

enum class Weight { kRegular, kBold };
enum class Align { kLeft, kCenter, kRight };

struct LabelStyle {
    int size = 15;  ///< Height of a line in pixels.
    Weight weight = Weight::kRegular;
    Srgb8 color{};
};

/// Width in pixels of one line of text: printable ASCII, other UTF-8 characters show as '?'.
/// Throws as findFont().
int labelWidth(const std::string& text, const LabelStyle& style);

/// Draws one line of UTF-8 text; x: its left end, its middle or its right end. Throws as
/// findFont().
void drawLabel(Canvas& canvas, int x, int baseline, const std::string& text,
               const LabelStyle& style, Align align = Align::kLeft);

/// The first of `candidates` (files, or names that OpenImageIO looks up) that is a font.
/// Throws std::runtime_error that names the package to install where there is none.
std::string findFont(std::span<const std::string> candidates);

}  // namespace abrdf
