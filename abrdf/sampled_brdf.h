// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/brdf_table.h"
#include "abrdf/pair_interpolation.h"

#include <vector>

namespace abrdf {

/// Values at the pairs of a grid, interpolated between them.
class SampledBrdf : public BrdfTable {
  public:
    /// values: one a pair of the grid, as evaluate() returns them.
    /// Throws std::invalid_argument for another number of them.
    SampledBrdf(AngularGrid grid, std::vector<Rgb> values);

    Rgb evaluate(const LightAndView& pair) const override {
        return interpolation_.value(pair, values_);
    }
    std::vector<Radians> viewElevations() const override {
        return AngularInterpolation(grid_.views()).ringThetas();
    }

    const AngularGrid& grid() const { return grid_; }
    const std::vector<Rgb>& values() const { return values_; }

  private:
    AngularGrid grid_;
    std::vector<Rgb> values_;
    PairInterpolation interpolation_;
};

}  // namespace abrdf
