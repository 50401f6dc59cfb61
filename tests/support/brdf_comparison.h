// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/brdf_table.h"

namespace abrdf {

/// How far one isotropic BRDF is from another, in the second channel.
struct BrdfComparison {
    double error = 0;      ///< Mean |difference| over the mean value, weighted by cos(theta_i), of
                           ///< lights up to 75 degrees.
    double energy = 0;     ///< Of a view's reflectance, relative: the worst view.
    double allEnergy = 0;  ///< Of the sum over the views.
    double highlight = 0;  ///< At the mirror direction, relative: the worst view.
    double reflectance = 0;      ///< The largest of `found`.
    double trueReflectance = 0;  ///< The largest of `truth`.
};

/// Over views of 4, 21, 37, 55 and 73 degrees. Lights are taken by even steps of the micronormal's
/// warped elevation, so that half a degree's lobe is met by dozens.
BrdfComparison compareBrdfs(const BrdfTable& truth, const BrdfTable& found);

}  // namespace abrdf
