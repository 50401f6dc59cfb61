// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"
#include "color/color_config.h"
#include "color/rgb.h"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

namespace abrdf {

/// Linear light of each code of an 8-bit image: a curve a channel and, where the transform mixes
/// channels as a change of primaries does, a matrix of what each adds to red, green and blue. As a
/// matrix may as well come after the average, it then costs nothing a pixel.
struct CodeTable {
    std::array<std::array<double, 256>, 3> curves{};
    std::optional<std::array<std::array<double, 3>, 3>> matrix;  ///< [output][channel].

    /// Linear red, green and blue of the curves' values, or of sums or means of them.
    std::array<double, 3> light(const std::array<double, 3>& channels) const;
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
    std::shared_ptr<const CodeTable> table_;
};

}  // namespace abrdf
