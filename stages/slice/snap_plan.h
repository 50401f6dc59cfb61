// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/sample_plan.h"

#include <cstdint>
#include <span>

namespace abrdf {

struct SnappedPlan {
    SamplePlan plan;          ///< Each sample at a pair of the grid.
    std::size_t stoodIn = 0;  ///< Samples whose nearest image is missing: another one stands in.
};

/// Takes every sample of `plan` to the nearest pair of the grid whose light and view both lie
/// within `bound` of it, an angle on the sphere each, and whose image is present; where none of
/// these is, to the nearest one, which is then a missing image. present: one flag a pair; empty:
/// all are. Throws std::runtime_error that lists the first five samples with no pair within the
/// bound, and how far away the nearest is.
SnappedPlan snapPlan(const SamplePlan& plan, const AngularGrid& grid,
                     std::span<const std::uint8_t> present, Radians bound);

}  // namespace abrdf
