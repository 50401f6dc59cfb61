// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/pair_interpolation.h"

#include <cstddef>
#include <vector>

namespace abrdf {

/// What a reconstruction method wants to be given.
enum class SampleWish {
    kSlices,  ///< The plan's samples at their exact places, interpolated from measured pairs.
    kMeasuredPairs,  ///< The distinct measured pairs nearest to the plan's, at their true
                     ///< directions.
    kEverything,     ///< Every pair of the database; for another grid, those that it needs.
};

/// The samples of a job, and of which measured pairs each is made.
struct SampleSet {
    std::vector<LightAndView> directions;            ///< Where each sample is.
    std::vector<std::vector<WeightedPair>> sources;  ///< What it is made of; weights sum to 1.
    std::vector<std::size_t> pairs;                  ///< All pairs in `sources`, ascending, once.
    std::size_t filled = 0;  ///< Missing pairs that were replaced by their neighbours, or dropped.
    std::vector<LightAndView> dropped;  ///< Samples that were wanted, and are missing.

    std::size_t count() const { return directions.size(); }
};

}  // namespace abrdf
