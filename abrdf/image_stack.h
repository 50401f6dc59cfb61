// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/zeroed_vector.h"
#include "color/rgb.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// Linear images of several pairs as a BTF stores them: image after image, each width x height
/// texels, row by row from the top. A texel that no valid pixel covered is NaN.
class ImageStack {
  public:
    ImageStack() = default;
    /// pairs: ascending pair indices of the database's grid, one an image.
    ImageStack(std::vector<std::size_t> pairs, int width, int height)
        : pairs_(std::move(pairs)),
          width_(width),
          height_(height),
          values_(pairs_.size() * texelCount()) {}

    const std::vector<std::size_t>& pairs() const { return pairs_; }
    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t texelCount() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    std::span<Rgb> image(std::size_t i) {
        return std::span(values_).subspan(i * texelCount(), texelCount());
    }
    std::span<const Rgb> image(std::size_t i) const {
        return std::span(values_).subspan(i * texelCount(), texelCount());
    }
    /// Image after image.
    std::span<const Rgb> values() const { return values_; }

  private:
    std::vector<std::size_t> pairs_;
    int width_ = 0;
    int height_ = 0;
    ZeroedVector<Rgb> values_;
};

}  // namespace abrdf
