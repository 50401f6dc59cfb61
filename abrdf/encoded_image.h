// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace abrdf {

/// One decoded photograph, still in the colour space of its file: packed RGB, row by row from the
/// top. Eight-bit images stay eight-bit (one table look-up away from linear light).
struct EncodedImage {
    int width = 0;
    int height = 0;
    std::variant<std::vector<std::uint8_t>, std::vector<float>>
        rgb;  ///< 3 * width * height values.
};

}  // namespace abrdf
