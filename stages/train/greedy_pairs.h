// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/progress.h"
#include "stages/train/conditioned_class.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// Random materials of each class for a choice over so many pairs: a thousand on UBO2003's grid,
/// fewer where a grid is so fine that they fill the memory.
std::size_t greedyMaterials(std::size_t pairs);

struct GreedyOptions {
    std::size_t count = 204;       ///< Pairs to choose, 1 .. candidates.
    std::size_t materials = 1000;  ///< Random materials of each class, >= 2.
    std::uint64_t seed = 1;        ///< Of the materials.
    std::vector<std::size_t> first =
        {};  ///< Pairs that are chosen already: the plan goes on from them.
};

struct GreedyChoice {
    std::vector<std::size_t> pairs;  ///< By falling worth: every prefix is the plan for its length.
    /// What is left of the weighted variance of the outputs after each choice, 1 .. 0.
    std::vector<double> variance;
    /// The root of that variance as a mean over the grid's pairs, in L*.
    std::vector<double> deviation;
};

/// Chooses the pairs of `grid` whose samples leave `prior` the least uncertainty, weighted by what
/// a display shows of it: at each step the pair with the largest sum over classes of (sum over
/// outputs of w C^2) / (C_jj + lambda) (design: estimator.md, section 4). candidates: pairs that
/// may be chosen; empty: all. The same choice for any number of threads. Ticks: phase "plan", unit
/// "samples". Throws std::invalid_argument, Cancelled.
GreedyChoice greedyPairs(const AngularGrid& grid, std::span<const std::size_t> candidates,
                         const GreedyOptions& options, const ProgressSink& progress);

/// The same where other pairs are watched than those of the grid.
GreedyChoice greedyPairs(const AngularGrid& grid, std::span<const std::size_t> candidates,
                         const WatchedPairs& watched, const GreedyOptions& options,
                         const ProgressSink& progress);

/// The same among the candidates of `classes`, which have their materials already: `pairs` of the
/// result, and options.first, count these candidates.
GreedyChoice greedyPairs(std::vector<ConditionedClass> classes, const GreedyOptions& options,
                         const ProgressSink& progress);

}  // namespace abrdf
