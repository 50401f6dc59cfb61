// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/drawing.h"

#include <cairo.h>

#include <numbers>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace {

void setColor(cairo_t* context, Srgb8 color) {
    cairo_set_source_rgb(context, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

void setFont(cairo_t* context, const TextStyle& style) {
    cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context, style.size);
}

}  // namespace

struct Drawing::Cairo {
    cairo_surface_t* surface;
    cairo_t* context;

    Cairo(int width, int height)
        : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)),
          context(cairo_create(surface)) {}
    ~Cairo() {
        cairo_destroy(context);
        cairo_surface_destroy(surface);
    }
    Cairo(const Cairo&) = delete;
    Cairo& operator=(const Cairo&) = delete;
};

Drawing::Drawing(int width, int height, Srgb8 background)
    : width_(width), height_(height), cairo_(std::make_unique<Cairo>(width, height)) {
    if (cairo_status(cairo_->context) != CAIRO_STATUS_SUCCESS) {
        throw std::runtime_error("the figure is too large to be drawn; choose fewer pairs");
    }
    rectangle(0, 0, width, height, background);
}

Drawing::~Drawing() = default;

double Drawing::textWidth(const std::string& line, const TextStyle& style) {
    setFont(cairo_->context, style);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo_->context, line.c_str(), &extents);
    return extents.x_advance;
}

void Drawing::text(double x, double y, const std::string& line, const TextStyle& style,
                   TextAlign align) {
    const double width = align == TextAlign::kLeft ? 0 : textWidth(line, style);
    setFont(cairo_->context, style);
    setColor(cairo_->context, style.color);
    cairo_move_to(cairo_->context, x - (align == TextAlign::kCenter ? width / 2 : width), y);
    cairo_show_text(cairo_->context, line.c_str());
}

void Drawing::rectangle(double x, double y, double width, double height, Srgb8 color) {
    setColor(cairo_->context, color);
    cairo_rectangle(cairo_->context, x, y, width, height);
    cairo_fill(cairo_->context);
}

void Drawing::circle(double x, double y, double radius, Srgb8 color, double lineWidth) {
    setColor(cairo_->context, color);
    cairo_set_line_width(cairo_->context, lineWidth);
    cairo_new_path(cairo_->context);
    cairo_arc(cairo_->context, x, y, radius, 0, 2 * std::numbers::pi);
    cairo_stroke(cairo_->context);
}

void Drawing::polyline(std::span<const PlacePoint> points, Srgb8 color, double lineWidth,
                       double dash) {
    setColor(cairo_->context, color);
    cairo_set_line_width(cairo_->context, lineWidth);
    cairo_set_line_join(cairo_->context, CAIRO_LINE_JOIN_ROUND);
    cairo_set_dash(cairo_->context, &dash, dash > 0 ? 1 : 0, 0);
    cairo_new_path(cairo_->context);
    for (const PlacePoint& p : points) cairo_line_to(cairo_->context, p.x, p.y);
    cairo_stroke(cairo_->context);
    cairo_set_dash(cairo_->context, nullptr, 0, 0);
}

void Drawing::image(double x, double y, double boxWidth, double boxHeight, int width, int height,
                    std::span<const Srgb8> colors) {
    std::vector<std::uint32_t> pixels;
    pixels.reserve(colors.size());
    for (const Srgb8& c : colors) {
        pixels.push_back(std::uint32_t{c[0]} << 16U | std::uint32_t{c[1]} << 8U | c[2]);
    }
    cairo_surface_t* source =
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                            CAIRO_FORMAT_RGB24, width, height, 4 * width);
    cairo_t* context = cairo_->context;
    cairo_save(context);
    cairo_translate(context, x, y);
    cairo_scale(context, boxWidth / width, boxHeight / height);
    cairo_set_source_surface(context, source, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
    cairo_rectangle(context, 0, 0, width, height);
    cairo_fill(context);
    cairo_restore(context);
    cairo_surface_destroy(source);
}

void Drawing::disc(double x, double y, double size, int side, std::span<const Srgb8> colors) {
    cairo_save(cairo_->context);
    cairo_new_path(cairo_->context);
    cairo_arc(cairo_->context, x + size / 2, y + size / 2, size / 2, 0, 2 * std::numbers::pi);
    cairo_clip(cairo_->context);
    image(x, y, size, size, side, side, colors);
    cairo_restore(cairo_->context);
}

CodedPicture Drawing::picture() const {
    cairo_surface_flush(cairo_->surface);
    CodedPicture picture;
    picture.width = width_;
    picture.height = height_;
    const unsigned char* row = cairo_image_surface_get_data(cairo_->surface);
    for (int y = 0; y < height_; ++y, row += cairo_image_surface_get_stride(cairo_->surface)) {
        const auto* pixels = reinterpret_cast<const std::uint32_t*>(row);
        for (int x = 0; x < width_; ++x) {
            for (const unsigned shift : {16U, 8U, 0U}) {
                picture.codes.push_back(static_cast<std::uint16_t>(pixels[x] >> shift & 0xFFU));
            }
        }
    }
    return picture;
}

}  // namespace abrdf
