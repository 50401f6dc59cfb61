// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace abrdf {

/// A scene-linear colour; which space its primaries belong to is said beside it, never in it.
struct Rgb {
    float r = 0;
    float g = 0;
    float b = 0;

    constexpr bool operator==(const Rgb&) const = default;
    constexpr Rgb& operator+=(Rgb c) { return *this = {r + c.r, g + c.g, b + c.b}; }
    constexpr Rgb& operator*=(float s) { return *this = {r * s, g * s, b * s}; }
};

constexpr Rgb operator+(Rgb a, Rgb b) {
    return a += b;
}
constexpr Rgb operator-(Rgb a, Rgb b) {
    return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr Rgb operator*(float s, Rgb c) {
    return c *= s;
}

/// False where any channel is NaN or infinite.
inline bool isFinite(Rgb c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

inline bool isNegative(Rgb c) {
    return c.r < 0 || c.g < 0 || c.b < 0;
}

}  // namespace abrdf
