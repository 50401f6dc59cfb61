// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <string>

namespace abrdf {

/// "THETA_I,PHI_I,THETA_V,PHI_V" in degrees, as options name a pair. Throws std::invalid_argument.
LightAndView pairFrom(const std::string& text);

/// "tl030 pl090 tv015 pv060": a pair as the databases write it.
std::string pairName(const LightAndView& pair);

}  // namespace abrdf
