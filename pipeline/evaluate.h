// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/plane.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// Reconstructions against the full measurement of one database, on its own grid.
struct EvaluateOptions {
    InputOptions input;
    std::vector<std::string> methods = {"published", "prior"};
    MethodChoice choice;  ///< Of each method; its name is not used.
    Texels texels;
    PlaneChoice plane;
    double exposure = 1;          ///< Factor on the values for the natural exposure, > 0.
    std::filesystem::path sheet;  ///< Contact sheet (PNG); empty: none.
};

/// Reads every image, runs the methods, measures. Returns the report of interface.md; the sheet
/// shows the mean over all texels. Throws as convert().
nlohmann::ordered_json evaluate(const EvaluateOptions& options, const ProgressSink& progress);

/// The poster's table of such a report, as text with one row a method and a heading.
std::string tableOf(const nlohmann::ordered_json& report);

}  // namespace abrdf
