// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/srgb8.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace abrdf {

struct Rectangle {
    int x = 0;  ///< Of the left edge, in pixels from the left.
    int y = 0;  ///< Of the upper edge, in pixels from the top.
    int width = 0;
    int height = 0;

    int right() const { return x + width; }
    int bottom() const { return y + height; }
};

/// An 8-bit sRGB picture to draw on, row by row from the top.
class Canvas {
  public:
    Canvas(int width, int height, Srgb8 background);

    int width() const { return width_; }
    int height() const { return height_; }
    Srgb8 at(int x, int y) const { return pixels_[index(x, y)]; }

    /// What lies outside the canvas is cut off.
    void fill(const Rectangle& area, Srgb8 color);

    /// Packed R, G, B.
    std::uint8_t* data() { return pixels_.front().data(); }
    const std::uint8_t* data() const { return pixels_.front().data(); }

  private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    int width_;
    int height_;
    std::vector<Srgb8> pixels_;
};

/// The bytes of a PNG file with that picture, tagged as sRGB; no time and no host in it.
std::string pngBytes(const Canvas& canvas);

}  // namespace abrdf
