// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"
#include "stages/preview/figure_style.h"

#include <optional>

namespace abrdf {

struct PolarPlot {
    std::string title;
    const Atlas* atlas = nullptr;      ///< Of one texel.
    const Atlas* reference = nullptr;  ///< A measurement of one texel to compare with, or null.
    std::vector<Radians> lightThetas;  ///< One column each.
    Radians lightPhi = 0;
};

/// For each light elevation a lobe plot in the plane of incidence (radius: logarithm of the value,
/// three decades) and the hemisphere of views as seen from above (distance from the centre: theta).
/// With a reference both are drawn, and their Delta E.
CodedPicture drawPolarPlot(const PolarPlot& plot, const FigureColors& colors,
                           const ColorTransform& toLinearRec709);

/// Where a view lies in a hemisphere plot of radius 1: x right, y up; theta 90 degrees is its edge.
PlacePoint placeOnHemisphere(Direction view);

/// The inverse; nothing outside the circle.
std::optional<Direction> viewOnHemisphere(const PlacePoint& place);

}  // namespace abrdf
