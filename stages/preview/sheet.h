// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/preview/figure_style.h"

#include <string>
#include <vector>

namespace abrdf {

/// One row of a sheet: a table of lights x views, or a map of texels at one pair. Colours are
/// scene-linear; every list has width x height values, or none.
struct SheetImages {
    std::string title;
    std::string caption;
    int width = 0;
    int height = 0;
    std::vector<Rgb> measurement;
    std::vector<Rgb> reconstruction;
    std::vector<float> deltaE;  ///< CIE 1976.
};

struct Sheet {
    std::string title;
    std::vector<SheetImages> rows;
    std::string note;  ///< What rows and columns of the images are.
};

/// Full measurement | reconstruction | Delta E, a row each; without measurements the
/// reconstructions alone. The figure is as large as its contents: text is never cut or shrunk.
/// Throws std::invalid_argument where a list has the wrong length or there is no row.
CodedPicture drawSheet(const Sheet& sheet, const FigureColors& colors);

/// Side length in pixels of one value of a row's images: 1 to 6 for tables, larger for few texels.
int sheetScale(const SheetImages& row);

/// Where the first pixel of a row's panel stands: column 0, 1 or 2.
PlacePoint sheetPanel(const Sheet& sheet, std::size_t row, int column);

}  // namespace abrdf
