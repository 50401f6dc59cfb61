// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/real_light.h"

#include <algorithm>
#include <limits>

namespace abrdf {

namespace {

/// True where all lie in 0 .. most; without a branch, so that compilers make vectors of it.
bool areLights(std::span<const Rgb> values, float most) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const float* channels = &values.front().r;
    int others = 0;
    for (std::size_t i = 0; i < 3 * values.size(); ++i) {
        const auto notNegative = static_cast<int>(channels[i] >= 0);
        others += 1 - (notNegative & static_cast<int>(channels[i] <= most));
    }
    return others == 0;
}

void makeLight(Rgb& value, float most, UnrealCounts& counts) {
    if (!isFinite(value)) {
        ++counts.nonfinite;
        value = {};
        return;
    }
    if (isNegative(value)) {
        ++counts.clamped;
        value = {std::max(value.r, 0.0F), std::max(value.g, 0.0F), std::max(value.b, 0.0F)};
    }
    const float largest = std::max({value.r, value.g, value.b});
    if (largest > most) {
        ++counts.dimmed;
        value *= most / largest;
    }
}

}  // namespace

float mostOfSamples(std::span<const Rgb> samples) {
    float largest = 0;
    for (const Rgb& c : samples) largest = std::max({largest, c.r, c.g, c.b});
    return std::min(kMostOfSamples * largest, std::numeric_limits<float>::max());
}

void makeLights(std::span<Rgb> values, float most, UnrealCounts& counts) {
    constexpr std::size_t kPiece = 512;  // Looked at while it is in the innermost cache.
    for (std::size_t begin = 0; begin < values.size(); begin += kPiece) {
        const auto piece = values.subspan(begin, std::min(kPiece, values.size() - begin));
        if (areLights(piece, most)) continue;
        for (Rgb& value : piece) makeLight(value, most, counts);
    }
}

}  // namespace abrdf
