// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "stages/read/read_options.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// Chooses the samples that are worth the most, and writes them to a file for --plan.
struct PlanJob {
    std::size_t samples = 204;       ///< At most.
    std::string grid = "ubo81";      ///< Whose pairs may be chosen and are to be reconstructed.
    std::filesystem::path input;     ///< Instead: the images of this database; or empty.
    ReadOptions read;                ///< Of the input.
    std::filesystem::path pairs;     ///< What a scene shows, as CSV: only that counts; or empty.
    bool continuous = false;         ///< Whole slices that a goniometer sweeps.
    std::vector<double> elevations;  ///< Of the slices, degrees; empty: 15, 30 .. 75.
    double travel = 0;               ///< Of the slices: samples that a full turn counts as.
    std::size_t materials = 0;       ///< Of each class; 0: 1,000, fewer for more than 6,561 pairs.
    std::uint64_t seed = 1;          ///< Of the random materials.
    std::filesystem::path output;
};

/// Returns {"command", "version", "plan": {"name", "samples"}, "grid": {"lights", "views"},
/// "candidates", "expected_error": [...], "steps": [{"samples", "delta_e"}], "enough", "travel":
/// {"light", "sensor", "sample"}, "free": {"delta_e", "travel"}, "slices": [...], "output":
/// {"path", "bytes"}, "time"}; angles in degrees; `free`, single samples at the slices' places, and
/// `slices` with --continuous only; `enough` null where more samples pay to the end. Ticks: phase
/// "plan". Throws std::invalid_argument for impossible numbers, std::runtime_error for files;
/// Cancelled.
nlohmann::ordered_json plan(const PlanJob& job, const ProgressSink& progress);

}  // namespace abrdf
