// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "color/color_config.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// A page of materials and figures.
struct PageOptions {
    std::vector<std::filesystem::path> atlases;
    std::vector<std::filesystem::path> reports;  ///< JSON files of other commands.
    std::filesystem::path output;
    std::optional<std::filesystem::path> colorConfig;
    DisplayView display;  ///< Its codes must be sRGB's, as browsers take them.
    double exposure = 1;  ///< With which the page opens, > 0.
    std::string title;    ///< Empty: the output's name.
};

/// Writes the page. Atlases of one source with one method "measured" among them are shown beside
/// that; maps are shown by the mean of their texels. Returns a report. Throws std::runtime_error
/// and std::invalid_argument with a sentence.
nlohmann::ordered_json writePage(const PageOptions& options, const ProgressSink& progress);

}  // namespace abrdf
