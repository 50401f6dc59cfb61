// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/goniometer.h"
#include "abrdf/progress.h"
#include "abrdf/sample_plan.h"
#include "abrdf/slice.h"
#include "pipeline/plan/plan.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace abrdf {

/// The samples that are worth the most for a job, with all that is told of them.
struct PlannedSamples {
    SamplePlan plan;
    AngularGrid grid;                      ///< What they are to reconstruct.
    std::vector<double> errors;            ///< Expected after each sample.
    std::size_t candidates = 0;            ///< Pairs, or slices, that could be chosen.
    std::vector<Slice> slices = {};        ///< Where whole ones were chosen.
    std::vector<std::size_t> sweep = {};   ///< The order in which to measure.
    std::optional<double> freeError = {};  ///< Of as many single samples as the slices have.
    Travel freeTravel = {};

    /// What the goniometer travels in the order of `sweep`.
    Travel sweptTravel() const;
};

/// Single pairs of the job's grid, database or scene, or whole slices (job.continuous). Ticks:
/// phase "plan". Throws std::invalid_argument for more samples than there are pairs,
/// std::runtime_error for files; Cancelled.
PlannedSamples planSamples(const PlanJob& job, const ProgressSink& progress);

}  // namespace abrdf
