// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "color/rgb.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// What lies beyond an image's edges.
enum class Edges {
    kPeriodic,  ///< The image again: left joins right, top joins bottom.
    kCropped,   ///< Nothing that is known.
};

/// In texels, to the right and down.
struct Shift {
    double x = 0;
    double y = 0;
};

/// Where an image rectified to the plane z = 0 shows what lies `height` texels above it, beside
/// its own place: -height tan(theta_v) along the view's azimuth; views past 87 degrees count as of
/// that.
Shift parallax(double height, Direction view);

/// Two neighbours along one axis of an image, and the second one's share.
struct Between {
    std::size_t first = 0;
    std::size_t second = 0;
    float share = 0;
    bool isInside = true;  ///< False: one lies outside a cropped image; its edge stands in.
};

/// The places 0 .. count - 1, each `shift` further.
std::vector<Between> shiftedPlaces(int count, double shift, Edges edges);

/// result(x, y) = image(x + shift.x, y + shift.y), linear between the four texels around; width *
/// height values each, row by row from the top, not the same memory. NaN where one of them is NaN
/// or lies outside a cropped image. Returns the number of texels that lie outside.
std::size_t shiftImage(std::span<const Rgb> image, int width, int height, Shift shift, Edges edges,
                       std::span<Rgb> result);

}  // namespace abrdf
