// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/weave.h"

#include <cmath>

namespace abrdf {

namespace {

constexpr float kThickness = 0.34F;  // height of a yarn's crest over its axis, in pitches
constexpr float kFullness = 0.94F;   // 1: the section's edge is vertical
constexpr float kCrimp = 0.12F;      // how far a yarn dives on either end of a float
constexpr int kRepeat = 3;           // 2/1 twill: over two, under one, shifted by one each row

/// x - floor(x / period) period, in 0 .. period.
float wrapped(float x, int period) {
    const auto p = static_cast<float>(period);
    const float rest = x - p * std::floor(x / p);
    return rest < p ? rest : 0;
}

}  // namespace

WeavePoint weaveAt(float x, float y) {
    const float u = wrapped(x, kWeaveYarns);
    const float v = wrapped(y, kWeaveYarns);
    const int column = static_cast<int>(u);
    const int row = static_cast<int>(v);
    const float inColumn = u - static_cast<float>(column);
    const float inRow = v - static_cast<float>(row);
    const int step = (column + row) % kRepeat;  // 0: the weft is on top; 1, 2: the warp's float

    WeavePoint point;
    const bool isWarp = step != 0;
    point.family = isWarp ? YarnFamily::kWarp : YarnFamily::kWeft;
    point.yarn = isWarp ? column : row;
    point.along = isWarp ? v : u;
    point.across = 2 * (isWarp ? inColumn : inRow) - 1;

    // Position on the float, -1 .. 1, and half its length.
    const float halfFloat = isWarp ? 1.0F : 0.5F;
    const float onFloat = isWarp ? static_cast<float>(step - 2) + inRow : 2 * inColumn - 1;

    // An elliptic section across; a parabola along.
    const float section = std::sqrt(1 - kFullness * point.across * point.across);
    const float dive = kCrimp * halfFloat;
    point.height = kThickness * section - dive * onFloat * onFloat;
    const float slopeAcross = -2 * kThickness * kFullness * point.across / section;
    const float slopeAlong = -2 * dive * onFloat / halfFloat;
    point.slopeX = isWarp ? slopeAcross : slopeAlong;
    point.slopeY = isWarp ? slopeAlong : slopeAcross;
    return point;
}

}  // namespace abrdf
