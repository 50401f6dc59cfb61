// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/chart/sweep.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// Accuracy against speed: every method at every size on given materials.
struct ChartOptions {
    std::vector<InputOptions> inputs;
    std::filesystem::path output;  ///< .svg or .png; the other one is written beside it. Or empty.
    std::filesystem::path csv;     ///< The figures over all inputs; or empty.
    std::vector<std::string> methods;  ///< Empty: all but `measured`.
    std::vector<std::size_t> samples = {16, 28, 52, 100, 204, 408};
    std::vector<int> ranks = {4, 8, 16, 32, 64};  ///< Of `prior`, beside full.
    bool calibrate = false;  ///< Keep the figures in the cache, for --budget and --tolerance.
    TrialOptions trial;
};

/// Returns {"command", "version", "inputs", "results": [{"method", "input", "plan", "samples",
/// "rank", "images_read", "delta_e", ...}], "summary": [...], "pareto": [...], "output"}. With
/// `calibrate` and no inputs the shipped figures' times are measured anew on a virtual material.
/// Throws as openInput(), planFor(), runGnuplot().
nlohmann::ordered_json chart(const ChartOptions& options, const ProgressSink& progress,
                             const MessageSink& warn);

/// The summary as a table for a terminal.
std::string chartTable(const nlohmann::ordered_json& report);

}  // namespace abrdf
