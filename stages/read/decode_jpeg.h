// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"
#include "stages/read/decode_image.h"

#include <optional>
#include <span>
#include <string>

namespace abrdf {

/// Decodes a JPEG through libjpeg-turbo itself, which is what OpenImageIO does too, a scanline at a
/// time and with a fifth more time; the pixels are the same. Grey becomes RGB. From any thread.
/// Nothing where the bytes are no JPEG or one of four inks: OpenImageIO knows more of those.
/// Throws std::runtime_error that names `name` where the image is not whole.
std::optional<EncodedImage> decodeJpeg(std::span<const char> bytes, const std::string& name,
                                       const ReadLimits& limits);

/// The size that its header declares; nothing and throws as decodeJpeg().
std::optional<ImageSize> jpegSize(std::span<const char> bytes, const std::string& name,
                                  const ReadLimits& limits);

}  // namespace abrdf
