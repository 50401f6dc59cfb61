// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/sample_plan.h"
#include "abrdf/sample_set.h"
#include "pipeline/job.h"
#include "stages/reconstruct/reconstructor.h"

namespace abrdf {

/// The samples for `method` onto the atlas's grid `output`, with missing images filled where that
/// was asked for. A BRDF table is sampled where the plan says, or measured where the atlas asks;
/// source k of its set is sample k. Throws std::runtime_error that counts the missing images and
/// names the first five.
SampleSet samplesFor(const Method& method, const SamplePlan& plan, const OpenedInput& input,
                     const AngularGrid& output);

/// The grid that the samples of `method` come from: a table is its own measurement on any grid.
const AngularGrid& sampledGrid(const Method& method, const OpenedInput& input,
                               const AngularGrid& output);

}  // namespace abrdf
