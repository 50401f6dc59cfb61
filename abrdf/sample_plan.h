// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/slice.h"
#include "abrdf/slice_plan.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// Which samples of a material to take.
struct SamplePlan {
    std::string name;                       ///< As it stands in headers: "eight", "greedy:52".
    std::vector<LightAndView> samples;      ///< Where they are wanted.
    std::optional<SlicePlan> posterSlices;  ///< Of the plan `poster`: what `published` works on.
};

/// "eight:100" -> its name and its bound on samples (0: none given).
struct PlanName {
    std::string base;
    std::size_t bound = 0;
};
/// Throws std::invalid_argument where what follows the colon is not a number of at least 8.
PlanName planNameFrom(const std::string& text);

/// The most samples a named plan takes where no bound is given.
inline constexpr std::size_t kPlanSamples = 204;

/// The poster's plan with its numbers. Its slices hold samples evenly from azimuth 0, `samples` the
/// same but for the diagonals, which begin at the mirror: the poster leaves that open, and the
/// highlight is worth a sample to methods that take samples one by one.
SamplePlan posterPlan(const SlicePlan& slices);

/// Eight slices in four subspaces whose numbers were chosen for least error of `prior`. bound: at
/// most so many distinct samples, 8 .. ; where they are to be snapped to the pairs of a grid, it
/// counts those.
SamplePlan eightPlan(std::size_t bound, const AngularGrid* snapTo);

/// Sixteen subspaces of four elevations, a few samples each: for a goniometer. bound: as above.
SamplePlan sixteenSlicesPlan(std::size_t bound, const AngularGrid* snapTo);

/// The pairs of UBO2003's grid by falling worth to `prior`: any prefix is a good plan.
/// They were found by greedyPairs() and are built in.
const std::vector<std::size_t>& greedyPairsOfUbo81();

/// A plan of measured pairs.
SamplePlan pairsPlan(const std::string& name, const AngularGrid& grid,
                     const std::vector<std::size_t>& pairs);

}  // namespace abrdf
