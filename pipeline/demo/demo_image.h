// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/color_config.h"
#include "color/rgb.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace abrdf {

enum class DemoFormat {
    kJpeg,  ///< sRGB, 8 bits, quality 95, no channel subsampled: clipped at 1, as UBO2003's.
    kExr,   ///< Linear Rec.709, half float: nothing is clipped.
};

/// "jpg" or "exr".
std::string_view extension(DemoFormat format);

/// Writes the images of a demo database: the same colours make the same bytes. Safe to use from
/// many threads at once.
class DemoImageWriter {
  public:
    /// Square images, `size` pixels each way.
    DemoImageWriter(int size, DemoFormat format);

    /// `colors`: linear Rec.709, row by row from the top; used up by the encoding.
    /// Throws std::runtime_error where `file` cannot be written.
    void write(const std::filesystem::path& file, std::span<Rgb> colors) const;

  private:
    int size_;
    DemoFormat format_;
    ColorTransform encoding_;
};

}  // namespace abrdf
