// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/analytic_material.h"
#include "abrdf/angular_grid.h"
#include "stages/train/watched_pairs.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace abrdf {

/// Materials as a display shows them (design: estimator.md, section 4).
struct ShownMaterials {
    /// Material, pair: ln(value / body + floor), centred. The body is the median of the grid's
    /// pairs away from mirrors.
    Eigen::MatrixXf logs;
    /// Of each watched pair: root of the mean squared sensitivity dL* / d ln B, at natural and
    /// highlight exposure, times the pairs it stands for.
    Eigen::VectorXd weight;
};

/// pairs: the grid's first, then any others; watched: of them.
ShownMaterials shownMaterials(std::span<const AnalyticMaterial> materials,
                              const std::vector<LightAndView>& pairs, const AngularGrid& grid,
                              const WatchedPairs& watched);

}  // namespace abrdf
