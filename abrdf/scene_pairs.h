// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

/// The pairs of directions that a scene shows, and how much each matters: a light rig before
/// cameras, or what a renderer writes of its pixels.
struct ScenePairs {
    std::string name;                 ///< Of its file, without folder and extension.
    std::vector<LightAndView> pairs;  ///< Distinct to a hundredth of a degree.
    std::vector<double> weights;      ///< Of each, >= 0; their sum is 1.
};

/// Rows theta_i,phi_i,theta_v,phi_v[,weight], angles in degrees, weight 1 where there is none; a
/// header line and lines that begin with # are passed over, equal pairs are added up.
/// Throws std::runtime_error that names file and line: of a direction at or below the horizon, a
/// weight that is negative or no number; of the file where it has no pair or no weight above 0.
ScenePairs scenePairsFromCsv(const std::filesystem::path& file);

/// The grid that a scene needs, its lights and its views each by themselves: their own directions
/// where these are no more than base has; else, of base, the rings among which they are
/// interpolated (all of it where it has no rings).
AngularGrid sceneGrid(const ScenePairs& scene, const AngularGrid& base);

/// How much each pair of a grid matters to a scene, as its pairs are interpolated from them (linear
/// estimate of PairInterpolation); the sum is 1.
std::vector<double> sceneWeights(const ScenePairs& scene, const AngularGrid& grid);

/// `count` indices (fewer where there are fewer weights), spread evenly over the sum of the
/// weights: a weight of a k-th of it is met `count` / k times, up to chance. At least one weight
/// is above 0.
std::vector<std::size_t> spreadByWeight(std::span<const double> weights, std::size_t count);

}  // namespace abrdf
