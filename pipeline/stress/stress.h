// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/reconstruction.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// Every method driven to where it fails.
struct StressOptions {
    std::vector<std::filesystem::path> inputs;  ///< Materials; none: analytic ones.
    std::optional<std::filesystem::path> colorConfig;
    std::vector<std::string> methods;  ///< None: all but `measured`.
    std::vector<std::string> cases;    ///< Names of stressCases(); none: all.
    PlanChoice plan;                   ///< Of the methods that can take any.
    std::string grid = "ubo81";        ///< As --grid.
    PriorSource prior;
    std::uint64_t seed = 1;        ///< Of noise and losses.
    std::filesystem::path output;  ///< Folder for the figures; made where it is absent.
};

/// Runs the cases and draws a figure of each, SVG and PNG, and `stress.json` into the folder.
/// Returns the report: "results" has a row for each case and method with its steps, errors and
/// breakdown. Throws std::invalid_argument for unknown names, and as evaluate() for inputs.
nlohmann::ordered_json stress(const StressOptions& options, const ProgressSink& progress,
                              const MessageSink& warn);

/// The matrix method x case of such a report as text: where each breaks down.
std::string breakdownTable(const nlohmann::ordered_json& report);

}  // namespace abrdf
