// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/convert/plane.h"
#include "pipeline/evaluate/evaluate_report.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// A view from above, one that a highlight is near, and a flat one with the light behind it.
std::vector<LightAndView> defaultImagePairs();

/// Reconstructions against the full measurement of one database, on its own grid.
struct EvaluateOptions {
    InputOptions input;
    std::vector<std::string> methods = {"published", "prior"};
    MethodChoice choice;  ///< Of each method; its name is not used.
    Texels texels;
    PlaneChoice plane;
    std::filesystem::path pairs;  ///< What a scene shows, as CSV: only that counts; or empty.
    double exposure = 1;          ///< Factor on the values for the natural exposure, > 0.
    std::filesystem::path sheet;  ///< Contact sheet (PNG); empty: none.
    /// Of the images that the sheet shows side by side where there is more than one texel.
    std::vector<LightAndView> imagePairs = defaultImagePairs();
};

/// Reads every image, runs the methods, measures. Returns the report of interface.md; the sheet
/// shows the mean over all texels. Throws as convert().
nlohmann::ordered_json evaluate(const EvaluateOptions& options, const ProgressSink& progress);

}  // namespace abrdf
