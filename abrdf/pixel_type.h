// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace abrdf {

/// How an atlas stores a channel.
enum class PixelType { kHalf, kFloat };

/// "half" or "float".
inline std::string nameOf(PixelType type) {
    return type == PixelType::kHalf ? "half" : "float";
}

/// Of one channel of a pixel.
inline std::size_t bytesOf(PixelType type) {
    return type == PixelType::kHalf ? 2 : 4;
}

/// The largest finite half.
inline constexpr float kLargestHalf = 65504;

}  // namespace abrdf
