// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"
#include "color/color_config.h"
#include "color/rgb.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// From a database's encoding to scene-linear light; built once a job, then used from any thread.
/// Eight-bit images of a per-channel encoding go through a table that the transform filled.
class Linearizer {
  public:
    explicit Linearizer(ColorTransform toSceneLinear);

    /// Linear colours of pixels [first, first + row.size()) of `image`.
    void linearize(const EncodedImage& image, std::size_t first, std::span<Rgb> row) const;

  private:
    ColorTransform transform_;
    std::vector<Rgb> table_;  ///< Linear light of each code in each channel; empty where none.
};

/// Averages an image, in linear light, over width x height texels that share its area evenly;
/// a pixel cut by a border counts by its parts. NaN, infinite and negative pixels are left out; a
/// texel without any valid pixel becomes NaN. texels: width * height values, row by row.
/// Returns the number of pixels left out. Throws std::invalid_argument for more texels than pixels.
std::size_t averageImage(const EncodedImage& image, const Linearizer& linearizer, int width,
                         int height, std::span<Rgb> texels);

}  // namespace abrdf
