// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/srgb8.h"

namespace abrdf {

/// From near black over violet, red and yellow to cream: t in 0 .. 1, clipped; lightness L* grows
/// evenly from 4 to 93, so that the order is seen without colour vision too. NaN is grey.
Srgb8 heatColor(double t);

}  // namespace abrdf
