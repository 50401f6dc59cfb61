// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/grazing_brdf.h"

#include <algorithm>

namespace abrdf {

bool GrazingBrdf::isExtrapolated(const LightAndView& pair) const {
    constexpr Radians kRounding = radiansFromDegrees(0.01);
    return std::max(pair.light.theta, pair.view.theta) > maxTheta_ + kRounding;
}

Rgb GrazingBrdf::evaluate(const LightAndView& pair) const {
    if (!isExtrapolated(pair)) return brdf_.evaluate(pair);
    Rgb sum;
    for (const GrazingTerm& light : grazingTerms(pair.light, maxTheta_, policy_, hasCosine_)) {
        for (const GrazingTerm& view : grazingTerms(pair.view, maxTheta_, policy_, false)) {
            sum += static_cast<float>(light.weight * view.weight) *
                   brdf_.evaluate({light.direction, view.direction});
        }
    }
    return {std::max(0.0F, sum.r), std::max(0.0F, sum.g), std::max(0.0F, sum.b)};
}

}  // namespace abrdf
