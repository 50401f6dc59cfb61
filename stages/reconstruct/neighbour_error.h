// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "color/rgb.h"

#include <span>
#include <vector>

namespace abrdf {

/// Mean CIE 1976 Delta E of each texel's samples against what `idw` makes of each from its four
/// nearest others, at an exposure. samples: texel after texel, linear Rec.709 or near it.
std::vector<float> neighbourErrors(const std::vector<LightAndView>& directions,
                                   std::span<const Rgb> samples, double exposure);

/// Their mean.
double neighbourError(const std::vector<LightAndView>& directions, std::span<const Rgb> samples,
                      double exposure);

}  // namespace abrdf
