// SPDX-License-Identifier: BSD-3-Clause
#include "color/heat_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

using Quintic = std::array<double, 6>;  // From t^0 to t^5.

// Least squares to L* = 6 + 88 t, hue 292 to 462 degrees, 0.9 of sRGB's chroma there.
constexpr std::array<Quintic, 3> kChannels{{
    {-0.002, 0.103, 13.376, -32.053, 28.219, -8.648},
    {0.050, 1.143, -10.343, 28.708, -27.263, 8.620},
    {0.168, 4.197, -19.472, 37.292, -36.911, 15.508},
}};
constexpr Srgb8 kUnknown{128, 128, 128};

double valueAt(const Quintic& p, double t) {
    return p[0] + t * (p[1] + t * (p[2] + t * (p[3] + t * (p[4] + t * p[5]))));
}

}  // namespace

Srgb8 heatColor(double t) {
    if (std::isnan(t)) return kUnknown;
    Srgb8 color{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double value = valueAt(kChannels[c], std::clamp(t, 0.0, 1.0));
        color[c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
    }
    return color;
}

}  // namespace abrdf
