// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// Angle between the half vector of a pair and the normal, 0 .. pi/2; 0 of a mirror.
Radians halfAngle(const LightAndView& pair);

/// Pairs whose uncertainty is watched.
struct WatchedPairs {
    std::vector<Eigen::Index> pairs;        ///< Of the grid; those after its own, of `others`.
    Eigen::VectorXd share;                  ///< How many pairs each of them stands for.
    std::vector<LightAndView> others = {};  ///< Off the grid.
};

/// All mirrors of the grid, and a random choice of the others.
WatchedPairs watchedPairs(const AngularGrid& grid, std::uint64_t seed);

/// Those that a scene shows, or where they are many a choice by their weights. weights: of each
/// pair, their sum is 1.
WatchedPairs watchedPairs(const AngularGrid& grid, const std::vector<LightAndView>& scene,
                          std::span<const double> weights);

}  // namespace abrdf
