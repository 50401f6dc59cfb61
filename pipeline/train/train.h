// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/plan/plan_choice.h"
#include "stages/train/train_prior.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace abrdf {

/// Trains the prior ahead of time, for batch nodes.
struct TrainJob {
    PlanChoice plan;
    std::string grid = "ubo81";    ///< Of the database and, unless told otherwise, the atlas.
    std::string outputGrid;        ///< Of the atlas; empty: `grid`.
    bool anywhere = false;         ///< The samples are taken where the plan says, not snapped.
    std::filesystem::path output;  ///< A file for --model; empty: the cache.
    TrainOptions options;
};

/// Returns {"command", "version", "plan": {"name", "samples"}, "grid": {"lights", "views"},
/// "output": {"path", "bytes"}, "time"}. Throws as planFor() and trainPrior(), and where neither an
/// output is given nor a cache folder is known.
nlohmann::ordered_json train(const TrainJob& job, const ProgressSink& progress,
                             const MessageSink& warn);

}  // namespace abrdf
