// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace abrdf {

/// One repeat of the cloth, a 2/1 twill: so many yarns each way. A multiple of 3.
constexpr int kWeaveYarns = 6;

enum class YarnFamily { kWarp, kWeft };

/// What lies on top at one place of a weave.
struct WeavePoint {
    YarnFamily family = YarnFamily::kWarp;
    int yarn = 0;      ///< 0 .. kWeaveYarns - 1, from the left or from the bottom.
    float across = 0;  ///< Position across the yarn, -1 .. 1 from edge to edge.
    float along = 0;   ///< Position along it in yarn pitches, 0 .. kWeaveYarns.
    float height = 0;  ///< In yarn pitches.
    float slopeX = 0;  ///< Derivative of the height to the right ...
    float slopeY = 0;  ///< ... and upwards.
};

/// The weave at x (right) and y (up), in yarn pitches; it repeats after kWeaveYarns.
WeavePoint weaveAt(float x, float y);

}  // namespace abrdf
