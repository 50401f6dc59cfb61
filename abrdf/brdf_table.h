// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "color/rgb.h"

#include <vector>

namespace abrdf {

/// A tabulated BRDF with an interpolation of its own: one texel, known at every pair of directions.
class BrdfTable {
  public:
    virtual ~BrdfTable() = default;

    /// Reflectance factor times cos(theta_i), pi f cos(theta_i), in the table's colour space; from
    /// any thread. NaN where the table has no data.
    virtual Rgb evaluate(const LightAndView& pair) const = 0;

    /// Elevations of the view that the table holds, ascending; between them it is interpolated.
    /// None where it has no such nodes.
    virtual std::vector<Radians> viewElevations() const { return {}; }
};

}  // namespace abrdf
