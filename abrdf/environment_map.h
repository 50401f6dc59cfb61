// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <cstddef>
#include <vector>

namespace abrdf {

/// Light from everywhere, as a picture of longitude and latitude: its middle is what a viewer who
/// looks along -z sees, its upper edge is straight up.
struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<Rgb> radiance;  ///< Row by row from the top, scene-linear.

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

}  // namespace abrdf
