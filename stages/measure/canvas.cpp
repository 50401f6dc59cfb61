// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/canvas.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace abrdf {

static_assert(sizeof(Srgb8) == 3, "pixels are handed on as packed bytes");

Canvas::Canvas(int width, int height, Srgb8 background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {
    assert(width > 0 && height > 0);
}

void Canvas::fill(const Rectangle& area, Srgb8 color) {
    const int left = std::clamp(area.x, 0, width_);
    const int right = std::clamp(area.right(), left, width_);
    const int bottom = std::min(area.bottom(), height_);
    for (int y = std::max(area.y, 0); y < bottom; ++y) {
        std::fill_n(pixels_.begin() + static_cast<std::ptrdiff_t>(index(left, y)), right - left,
                    color);
    }
}

std::string pngBytes(const Canvas& canvas) {
    OIIO::ImageSpec spec(canvas.width(), canvas.height(), 3, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");

    OIIO::Filesystem::IOVecOutput file;
    const auto png = OIIO::ImageOutput::create("png", &file);
    if (!png) {
        throw std::runtime_error(fmt::format("OpenImageIO cannot write PNG: {}", OIIO::geterror()));
    }
    if (!png->open("memory.png", spec) || !png->write_image(OIIO::TypeDesc::UINT8, canvas.data()) ||
        !png->close()) {
        throw std::runtime_error(fmt::format("the PNG cannot be encoded: {}", png->geterror()));
    }
    return {file.buffer().begin(), file.buffer().end()};
}

}  // namespace abrdf
