// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"
#include "stages/page/page_table.h"

#include <ImathVec.h>
#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// One entry of the page's list: a reconstruction, the measurement it is compared with, or both.
struct PageMaterial {
    std::string name;     ///< "corduroy.zip"
    std::string caption;  ///< "published, plan poster, 204 samples"
    std::optional<PageTable> reconstruction;
    std::optional<PageTable> measurement;
    std::string picture;          ///< JPEG bytes, for browsers without WebGL2.
    std::string measuredPicture;  ///< The same of the measurement; empty: none.
};

/// A distant light of an environment: direction and strength, as in stages/preview.
struct PageLight {
    Imath::V3d direction;
    Rgb strength;
};

struct PageEnvironment {
    std::string name;  ///< "Studio"
    std::vector<PageLight> lights;
    std::optional<PageLight> sun;  ///< Evaluated exactly, as a single light is.
};

/// A view of the colour config as a cube of codes: what the page shows with tone curve 1.
struct PageView {
    std::string name;                 ///< "ACES 1.0 - SDR Video"
    int side = 0;                     ///< Samples along each edge.
    std::vector<std::uint8_t> codes;  ///< R, G, B; red runs fastest.
};

/// The place of a linear value along an edge of such a cube, 0 .. 1, and its inverse:
/// u = log2(1 + 1024 x) / 16, so that 64 is the end.
double cubePlace(double value);
double cubeValue(double place);

/// A table of text and numbers, sortable by each column.
struct PageDataTable {
    std::string title;
    std::string note;
    std::vector<std::string> columns;
    std::vector<std::vector<nlohmann::json>> rows;  ///< Strings, numbers or null.
};

/// One point of the error-time chart.
struct PagePoint {
    std::string method;
    std::string input;
    double microseconds = 0;  ///< An ABRDF.
    double deltaE = 0;        ///< Mean CIE 1976.
    int samples = 0;
};

struct PageContent {
    std::string title;
    std::vector<PageMaterial> materials;
    std::vector<PageEnvironment> environments;
    PageView view;
    double exposure = 1;
    std::array<float, 3> background{0.05F, 0.05F, 0.05F};  ///< Scene-linear.
    std::vector<PagePoint> points;
    std::vector<PageDataTable> tables;
    std::vector<PageDataTable> matrices;  ///< First column: the case.
    std::string colorNote;                ///< What was converted from what to what.
};

}  // namespace abrdf
