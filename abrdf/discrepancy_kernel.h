// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "abrdf/material_class.h"

#include <Eigen/Core>

#include <vector>

namespace abrdf {

/// How alike the deviations of a real material from random ones are at two pairs, 0 .. 1; 1 for
/// the same pair. A mean of exponentials of distances: of the half angle, of both elevations, and
/// (counted twice) of all features, which hold the unit vectors too but for class iso.
/// length: of all three, in units of the features of pair_features.h. A row for each of a, a
/// column for each of b.
/// Compared with one Gaussian of all features it takes .13 off the prior's Delta E of luminance.
Eigen::MatrixXd discrepancyKernel(MaterialClass materialClass, const std::vector<LightAndView>& a,
                                  const std::vector<LightAndView>& b, double length);

}  // namespace abrdf
