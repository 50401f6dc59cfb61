// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "stages/reconstruct/microfacet_fit.h"

namespace abrdf {

/// PreparedLobe of a fit (GGX) in double precision, to see what its floats do.
class DoubleLobe {
  public:
    using Pair = LightAndView;

    explicit DoubleLobe(const MicrofacetFit& fit) : fit_(fit) {}

    /// pi D G F / (4 cos_i cos_o), bounded at grazing as PreparedLobe's is.
    double reflectanceFactor(const LightAndView& pair) const;

  private:
    MicrofacetFit fit_;
};

}  // namespace abrdf
