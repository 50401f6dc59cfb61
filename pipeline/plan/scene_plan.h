// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/progress.h"
#include "abrdf/sample_plan.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// What a scene asks to be filled in.
struct SceneOutputs {
    std::string name;             ///< As ScenePairs.
    std::vector<double> weights;  ///< How much each pair of the output grid matters; sum 1.
};

struct ScenePlanOptions {
    std::size_t bound = kPlanSamples;  ///< Samples at most.
    /// Fewer where more stop paying, or where so many are expected to be within the tolerance.
    bool mayBeFewer = true;
    double tolerance = 0;  ///< Mean CIE 1976 Delta E over the scene's pairs; 0: none is asked for.
};

/// A plan for the pairs that a scene shows, and for no others.
struct ScenePlan {
    SamplePlan plan;
    double expectedError = 0;  ///< Mean CIE 1976 Delta E over the scene's pairs.
};

/// Chooses, of the measured pairs, those whose samples leave the least uncertainty at what the
/// scene shows of the output grid; kept in the cache.
/// present: one flag a measured pair, empty: all are. Ticks: phase "plan".
/// Throws std::invalid_argument where there are no pairs to choose from; Cancelled.
ScenePlan scenePlan(const SceneOutputs& scene, const AngularGrid& output,
                    const AngularGrid& measured, std::span<const std::uint8_t> present,
                    const ScenePlanOptions& options, const ProgressSink& progress,
                    const MessageSink& warn);

}  // namespace abrdf
