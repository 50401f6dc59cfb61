// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/coded_picture.h"
#include "color/srgb8.h"

#include <memory>
#include <span>
#include <string>

namespace abrdf {

enum class TextAlign { kLeft, kCenter, kRight };

struct TextStyle {
    double size = 15;  ///< Em in pixels.
    bool bold = false;
    Srgb8 color{};
};

struct PlacePoint {
    double x = 0;  ///< Pixels from the left.
    double y = 0;  ///< Pixels from the top.
};

/// A figure to draw on with smooth lines and text: cairo behind a small face. Colours are codes of
/// the display.
class Drawing {
  public:
    Drawing(int width, int height, Srgb8 background);
    ~Drawing();
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    int width() const { return width_; }
    int height() const { return height_; }

    /// One line of UTF-8 text; y: its baseline. x: its left end, its middle or its right end.
    void text(double x, double y, const std::string& line, const TextStyle& style,
              TextAlign align = TextAlign::kLeft);
    double textWidth(const std::string& line, const TextStyle& style);

    void rectangle(double x, double y, double width, double height, Srgb8 color);
    void circle(double x, double y, double radius, Srgb8 color, double lineWidth);

    /// dash: lengths of dash and gap in pixels; 0: none.
    void polyline(std::span<const PlacePoint> points, Srgb8 color, double lineWidth,
                  double dash = 0);

    /// Each of width x height colours as a square of `scale` pixels, or as one of `box` pixels
    /// altogether; sharp.
    void image(double x, double y, double boxWidth, double boxHeight, int width, int height,
               std::span<const Srgb8> colors);

    /// The same within a circle alone, whose box (x, y) and size are given.
    void disc(double x, double y, double size, int side, std::span<const Srgb8> colors);

    /// 8-bit codes; the drawing may go on.
    CodedPicture picture() const;

  private:
    struct Cairo;
    int width_;
    int height_;
    std::unique_ptr<Cairo> cairo_;
};

}  // namespace abrdf
