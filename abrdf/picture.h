// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <ImathVec.h>

#include <cstddef>
#include <vector>

namespace abrdf {

/// A rendered picture, row by row from the top; every list has width x height values.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<Rgb> color;           ///< Scene-linear, already multiplied by alpha.
    std::vector<float> alpha;         ///< Share of the pixel that the object covers, 0 .. 1.
    std::vector<float> depth;         ///< Distance from the camera, scene units; 0: nothing there.
    std::vector<Imath::V3f> normals;  ///< In the scene's frame; 0: nothing there.

    Picture() = default;
    Picture(int pixelsWide, int pixelsHigh)
        : width(pixelsWide),
          height(pixelsHigh),
          color(count()),
          alpha(count()),
          depth(count()),
          normals(count(), Imath::V3f(0)) {}

    std::size_t count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

}  // namespace abrdf
