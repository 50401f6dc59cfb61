// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"
#include "stages/measure/canvas.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// One image of a map, side by side.
struct SheetImage {
    std::string title;  ///< "tl030 pl090 tv000 pv000, not sampled"
    std::vector<Rgb> measurement;
    std::vector<Rgb> reconstruction;
};

/// One method. All colours of a sheet are scene-linear Rec.709, one a pair, pair = light * views +
/// view.
struct SheetRow {
    std::string title;    ///< "published, poster, 204 samples"
    std::string caption;  ///< "Delta E 7.9   PSNR 20.4 dB"
    std::vector<Rgb> reconstruction;
    std::vector<SheetImage> images = {};  ///< Shown below it; as many in each row.
};

struct ContactSheet {
    std::string title;
    std::size_t lights = 0;
    std::size_t views = 0;
    std::vector<Rgb> measurement;
    std::vector<SheetRow> rows;
    double exposure = 1;  ///< Factor on all values before they are shown, > 0.
    int imageWidth = 0;   ///< Texels of the rows' images.
    int imageHeight = 0;
};

/// The three pictures of a row.
enum class Panel { kMeasurement = 0, kReconstruction = 1, kDeltaE = 2 };

/// Delta E of the last colour of the map; whatever is larger has this colour too.
inline constexpr double kSheetDeltaE = 20;

/// Where the picture of a row stands in the file, and its pixels a pair: pair (light, view) is the
/// square of `scale` pixels at (x + view * scale, y + light * scale).
Rectangle panelRectangle(const ContactSheet& sheet, std::size_t row, Panel panel);

/// The same of an image of a row.
Rectangle imageRectangle(const ContactSheet& sheet, std::size_t row, std::size_t image,
                         Panel panel);
int panelScale(const ContactSheet& sheet);

/// Writes an 8-bit sRGB PNG: a row a method, with the full measurement, the reconstruction and
/// the map of their CIE 1976 Delta E, below it the same of its images; the same sheet gives the
/// same bytes.
/// Throws std::invalid_argument where a table has not lights x views values or there is none, or an
/// image has another size than the sheet says,
/// std::runtime_error where the file cannot be written or no font is found.
void writeContactSheet(const std::filesystem::path& path, const ContactSheet& sheet);

}  // namespace abrdf
