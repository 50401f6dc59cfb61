// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <cstdint>
#include <span>

namespace abrdf {

/// Finite and nowhere negative.
inline bool isLight(Rgb c) {
    return isFinite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0;
}

/// How many values a reconstruction made that no light has.
struct UnrealCounts {
    std::uint64_t clamped = 0;    ///< Negative ones, set to 0.
    std::uint64_t nonfinite = 0;  ///< NaN and infinite ones, set to 0.
    /// Those above kMostOfSamples times the texel's largest sample, dimmed to that: a highlight
    /// that the samples only suggest is not made up at any height.
    std::uint64_t dimmed = 0;

    UnrealCounts& operator+=(const UnrealCounts& other) {
        clamped += other.clamped;
        nonfinite += other.nonfinite;
        dimmed += other.dimmed;
        return *this;
    }
};

inline constexpr float kMostOfSamples = 4;

/// kMostOfSamples times the largest channel of a texel's samples; finite.
float mostOfSamples(std::span<const Rgb> samples);

/// Makes lights of values: none unreal, negative or above `most`. Counts those that it changed.
void makeLights(std::span<Rgb> values, float most, UnrealCounts& counts);

}  // namespace abrdf
