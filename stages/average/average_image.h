// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"
#include "color/color_config.h"
#include "color/rgb.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// Linear light of each code of an 8-bit image: a curve a channel and, where the transform mixes
/// channels as a change of primaries does, a matrix of what each adds to red, green and blue. As a
/// matrix may as well come after the average, it then costs nothing a pixel.
struct CodeTable {
    std::array<std::array<double, 256>, 3> curves{};
    std::optional<std::array<std::array<double, 3>, 3>> matrix;  ///< [output][channel].
};

/// From a database's encoding to scene-linear light; built once a job, then used from any thread.
class Linearizer {
  public:
    explicit Linearizer(ColorTransform toSceneLinear);

    /// Linear colours of pixels [first, first + row.size()) of `image`.
    void linearize(const EncodedImage& image, std::size_t first, std::span<Rgb> row) const;

    /// What the transform makes of 8-bit codes, where it is curves and a matrix; else null.
    const CodeTable* table() const { return table_.get(); }

  private:
    ColorTransform transform_;
    std::shared_ptr<CodeTable> table_;
};

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
