// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"
#include "color/rgb.h"
#include "stages/average/linearizer.h"

#include <cstddef>
#include <span>

namespace abrdf {

/// Averages an image, in linear light, over width x height texels that share its area evenly;
/// a pixel cut by a border counts by its parts. Pixels that are stored NaN, infinite or negative
/// are left out; a texel without any valid pixel becomes NaN. A colour outside the working space
/// counts with its negative channel, and a texel's mean is cut at 0. texels: width * height values,
/// row by row. Returns the number of pixels left out. Throws std::invalid_argument for more texels
/// than pixels.
std::size_t averageImage(const EncodedImage& image, const Linearizer& linearizer, int width,
                         int height, std::span<Rgb> texels);

/// The same of an image that is linear already: imageWidth * imageHeight colours.
void averageColors(std::span<const Rgb> colors, int imageWidth, int imageHeight, int width,
                   int height, std::span<Rgb> texels);

}  // namespace abrdf
