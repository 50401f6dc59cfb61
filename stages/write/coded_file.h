// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/coded_picture.h"

#include <string>

namespace abrdf {

/// The bytes of a PNG file. An sRGB picture has the chunk sRGB (with gAMA and cHRM for old
/// readers), any other known encoding cICP where H.273 has it and an ICC profile where that can
/// state it. No time and no host. Throws std::runtime_error where libpng cannot.
std::string pngBytes(const CodedPicture& picture);

/// The bytes of a JPEG file with an ICC profile, 4:4:4. quality: 1 .. 100. Throws
/// std::invalid_argument for 16 bits, alpha or PQ, which JPEG cannot hold.
std::string jpegBytes(const CodedPicture& picture, int quality);

}  // namespace abrdf
