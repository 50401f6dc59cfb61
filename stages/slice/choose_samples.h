// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/sample_plan.h"
#include "abrdf/sample_set.h"

#include <cstdint>
#include <span>

namespace abrdf {

/// The samples of `plan` over a database's grid, in the form that a method wishes: sample i of
/// kSlices is plan.posterSlices->samples()[i]; kMeasuredPairs and kEverything come in the order of
/// the pairs.
SampleSet chooseSamples(const SamplePlan& plan, const AngularGrid& grid, SampleWish wish);

/// Those pairs of a grid, as they are. pairs: ascending.
SampleSet samplesOfPairs(const AngularGrid& grid, const std::vector<std::size_t>& pairs);

/// Samples of a database that is known everywhere, exactly where they are wanted: "pair" k is
/// sample k.
SampleSet exactSamples(std::vector<LightAndView> directions);

/// Those of set.pairs that the database lacks. present: one flag a pair of the grid.
std::vector<std::size_t> missingPairs(const SampleSet& set, std::span<const std::uint8_t> present);

/// Leaves out every sample of a missing pair; `dropped` lists them, `filled` counts them.
/// Throws std::runtime_error where nothing is left.
SampleSet dropMissing(SampleSet set, std::span<const std::uint8_t> present);

/// Replaces every missing pair by its (at most four) nearest present ones, weighted by inverse
/// squared distance of both directions; `filled` counts the pairs replaced.
/// Throws std::runtime_error where nothing is present.
SampleSet fillMissing(SampleSet set, const AngularGrid& grid,
                      std::span<const std::uint8_t> present);

}  // namespace abrdf
