// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/progress.h"
#include "abrdf/slice.h"
#include "stages/train/conditioned_class.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

/// The slices that a goniometer may sweep.
struct SliceFamily {
    std::vector<Radians> elevations;     ///< Of light and sensor, each from the normal, 0 .. pi/2.
    int offsets = 12;                    ///< Of both kinds, evenly in 0 .. 2 pi.
    std::vector<int> axialCounts = {4};  ///< Samples of an axial slice.
    std::vector<int> diagonalCounts = {9};  ///< Odd: estimator.md, section 4.
};

/// Every slice of the family: pairs of elevations by kinds, offsets and counts.
/// Throws std::invalid_argument for an elevation that is not above 0 and below 90 degrees, two that
/// are equal, and counts below 1.
std::vector<Slice> slicesOf(const SliceFamily& family);

struct GreedySliceOptions {
    std::size_t count = 204;       ///< Samples at most.
    std::size_t materials = 1000;  ///< Random materials of each class, >= 2.
    std::uint64_t seed = 1;        ///< Of the materials.
    double travel = 0;             ///< A full turn of anything counts as so many samples; >= 0.
    bool free = false;  ///< Choose samples of the slices one by one as well, to compare with.
};

struct GreedySlices {
    std::vector<Slice> slices;      ///< By falling worth.
    std::vector<double> deviation;  ///< After each of their samples: GreedyChoice::deviation.
    /// The same of as many single samples of all the slices, where options.free asked for it.
    std::vector<double> freeDeviation;
    std::vector<LightAndView> freeSamples;
};

/// Chooses whole slices as greedyPairs() does pairs: at each step the one whose samples together
/// explain the most of the weighted variance for what it costs, until none has room below
/// options.count. Cost: its samples, and its travel with the way from the nearest slice chosen.
/// The same choice for any number of threads. Ticks: phase "plan", unit "samples".
/// Throws std::invalid_argument where not even one has room; Cancelled.
GreedySlices greedySlices(const AngularGrid& grid, const WatchedPairs& watched,
                          const std::vector<Slice>& slices, const GreedySliceOptions& options,
                          const ProgressSink& progress);

/// The same, watching watchedPairs(grid).
GreedySlices greedySlices(const AngularGrid& grid, const std::vector<Slice>& slices,
                          const GreedySliceOptions& options, const ProgressSink& progress);

}  // namespace abrdf
