// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/known_display.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abrdf {

/// A picture in the codes of a display, as PNG and JPEG hold it.
struct CodedPicture {
    int width = 0;
    int height = 0;
    int bits = 8;                      ///< 8 or 16 a channel.
    int channels = 3;                  ///< 3: RGB; 4: RGB and alpha, not multiplied by it.
    std::vector<std::uint16_t> codes;  ///< Packed, row by row from the top, 0 .. 2^bits - 1.
    /// What the codes mean; nothing where it is none that a file could state.
    std::optional<DisplayEncoding> encoding;
    std::vector<std::pair<std::string, std::string>> notes;  ///< Keyword and text, Latin-1.
};

}  // namespace abrdf
