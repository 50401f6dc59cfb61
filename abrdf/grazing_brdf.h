// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/brdf_table.h"
#include "abrdf/grazing.h"

namespace abrdf {

/// A BRDF that is measured up to an elevation, at any pair above the surface. `brdf` must outlive
/// it.
class GrazingBrdf : public BrdfTable {
  public:
    GrazingBrdf(const BrdfTable& brdf, Radians maxTheta, Grazing policy, Cosine cosine)
        : brdf_(brdf), maxTheta_(maxTheta), policy_(policy), hasCosine_(cosine == Cosine::kKept) {}

    Rgb evaluate(const LightAndView& pair) const override;
    std::vector<Radians> viewElevations() const override { return brdf_.viewElevations(); }

    bool isExtrapolated(const LightAndView& pair) const;

  private:
    const BrdfTable& brdf_;
    Radians maxTheta_;
    Grazing policy_;
    bool hasCosine_;
};

}  // namespace abrdf
