// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

namespace abrdf {

/// A pair of directions as the sample sees it once it is turned by -angle.
inline LightAndView turnedPair(const LightAndView& pair, Radians angle) {
    return {{pair.light.theta, wrappedAzimuth(pair.light.phi + angle)},
            {pair.view.theta, wrappedAzimuth(pair.view.phi + angle)}};
}

}  // namespace abrdf
