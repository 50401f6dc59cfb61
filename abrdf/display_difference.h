// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/portable_math.h"
#include "color/rgb.h"

#include <cmath>
#include <cstddef>

namespace abrdf {

/// CIE L*a*b* under D65 in floats.
struct DisplayLab {
    float L, a, b;
};

/// As labFromLinearRec709(), within 1e-3: the same bits with every libm, a tenth of the time.
inline DisplayLab displayLab(Rgb color) {
    const auto clipped = [](float x) { return x < 0 ? 0.0F : x > 1 ? 1.0F : x; };
    const auto curve = [](float t) {
        constexpr float kKnee = 216.0F / 24389.0F;
        const float root = portable::pow(t > kKnee ? t : kKnee, 1.0F / 3);
        return t > kKnee ? root : t * (841.0F / 108) + 4.0F / 29;
    };
    const float r = clipped(color.r);
    const float g = clipped(color.g);
    const float b = clipped(color.b);
    const float x = curve((0.4124F * r + 0.3576F * g + 0.1805F * b) / 0.9505F);
    const float y = curve(0.2126F * r + 0.7152F * g + 0.0722F * b);
    const float z = curve((0.0193F * r + 0.1192F * g + 0.9505F * b) / 1.0890F);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// displayLab(exposure * color) of `count` colours, with the widest registers of the processor: its
/// bits on each.
void displayLabs(const Rgb* colors, std::size_t count, float exposure, DisplayLab* labs);

/// CIE 1976 colour difference.
inline float displayDifference(const DisplayLab& p, const DisplayLab& q) {
    const float L = p.L - q.L;
    const float a = p.a - q.a;
    const float b = p.b - q.b;
    return std::sqrt(L * L + a * a + b * b);
}

}  // namespace abrdf
