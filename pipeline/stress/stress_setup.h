// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "pipeline/stress/stress.h"
#include "pipeline/stress/stress_trial.h"
#include "stages/stress/stress_case.h"

#include <vector>

namespace abrdf {

/// What the options of a stress test name.
struct StressSetup {
    std::vector<StressCase> cases;
    AngularGrid grid;
    std::vector<StressMethod> methods;
    std::vector<StressMaterial> materials;  ///< Averages of the inputs, else analytic ones.
};

/// Reads the inputs and plans the methods' samples. Throws as stress().
StressSetup setUpStress(const StressOptions& options, const ProgressSink& progress,
                        const MessageSink& warn);

}  // namespace abrdf
