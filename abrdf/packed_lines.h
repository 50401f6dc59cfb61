// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/pixel_type.h"
#include "color/rgb.h"

#include <cstddef>
#include <cstdint>

namespace abrdf {

/// A place in a tile as OpenEXR stores it, little endian: in each line the channels B, G and R, one
/// after the other.
struct PackedLines {
    char* begin = nullptr;          ///< Of the first line's piece of B.
    std::size_t channelStride = 0;  ///< Bytes from a line's B to its G, and on to its R.
    std::size_t lineStride = 0;     ///< Bytes from line to line.
};

/// Packs lines x width colours, row by row. Halfs are rounded to nearest, ties to even; a colour
/// with a channel past 65504, infinite or NaN is cut to it. Returns the number of colours cut.
std::uint64_t packLines(const Rgb* colors, std::size_t lines, std::size_t width, PixelType type,
                        const PackedLines& place);

/// Packed halfs of `count` colours; returns the number cut, as packLines().
std::uint64_t halfsFrom(const Rgb* colors, std::size_t count, std::uint16_t* halfs);

}  // namespace abrdf
