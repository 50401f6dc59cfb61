// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/label.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

// Debian's place first; the bare name is looked up in $OPENIMAGEIO_FONTS and the system's folders.
std::string fontOf(Weight weight) {
    const std::string name = weight == Weight::kBold ? "DejaVuSans-Bold" : "DejaVuSans";
    return findFont(std::array{fmt::format("/usr/share/fonts/truetype/dejavu/{}.ttf", name),
                               fmt::format("/usr/share/fonts/TTF/{}.ttf", name), name});
}

// OpenImageIO 2.4.7 takes the last byte of a UTF-8 sequence for the character (its issue #3933).
std::string printable(const std::string& text) {
    std::string ascii;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool continues = (byte & 0xC0U) == 0x80U;
        if (continues) continue;
        ascii += byte >= 0x80U ? '?' : byte < ' ' || byte == 0x7F ? ' ' : c;
    }
    return ascii;
}

OIIO::ROI extent(const std::string& text, int size, const std::string& font) {
    return OIIO::ImageBufAlgo::text_size(text, size, font);
}

int shift(int width, Align align) {
    switch (align) {
        case Align::kLeft:
            return 0;
        case Align::kCenter:
            return width / 2;
        case Align::kRight:
            return width;
    }
    return 0;
}

}  // namespace

std::string findFont(std::span<const std::string> candidates) {
    for (const std::string& candidate : candidates) {
        if (extent("x", 16, candidate).defined()) return candidate;
    }
    throw std::runtime_error(
        "no font for the labels of the contact sheet: install DejaVu Sans (on Debian: "
        "apt-get install fonts-dejavu-core), or name its folder in OPENIMAGEIO_FONTS");
}

int labelWidth(const std::string& text, const LabelStyle& style) {
    if (text.empty()) return 0;
    const OIIO::ROI roi = extent(printable(text), style.size, fontOf(style.weight));
    return roi.defined() ? roi.xend : 0;
}

void drawLabel(Canvas& canvas, int x, int baseline, const std::string& text,
               const LabelStyle& style, Align align) {
    if (text.empty()) return;
    const std::array color{static_cast<float>(style.color[0]) / 255,
                           static_cast<float>(style.color[1]) / 255,
                           static_cast<float>(style.color[2]) / 255};
    const OIIO::ImageSpec spec(canvas.width(), canvas.height(), 3, OIIO::TypeDesc::UINT8);
    OIIO::ImageBuf picture(spec, canvas.data());  // A view: the text goes into the canvas.
    const bool drawn = OIIO::ImageBufAlgo::render_text(
        picture, x - shift(labelWidth(text, style), align), baseline, printable(text), style.size,
        fontOf(style.weight), color, OIIO::ImageBufAlgo::TextAlignX::Left,
        OIIO::ImageBufAlgo::TextAlignY::Baseline, 0, OIIO::ROI(), 1);
    if (!drawn) {
        throw std::runtime_error(
            fmt::format("the label '{}' cannot be drawn: {}", text, picture.geterror()));
    }
}

}  // namespace abrdf
