// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <limits>
#include <span>

namespace abrdf {

/// The mean of the finite colours; NaN where there is none.
inline Rgb meanOfFinite(std::span<const Rgb> colors) {
    double sum[3] = {};
    double count = 0;
    for (const Rgb& c : colors) {
        if (!isFinite(c)) continue;
        sum[0] += static_cast<double>(c.r);
        sum[1] += static_cast<double>(c.g);
        sum[2] += static_cast<double>(c.b);
        ++count;
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    if (count == 0) return {kNaN, kNaN, kNaN};
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
            static_cast<float>(sum[2] / count)};
}

}  // namespace abrdf
