// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/encoded_image.h"
#include "stages/read/read_limits.h"

#include <span>
#include <string>

namespace abrdf {

/// True where OpenImageIO reads files with this name's extension (in any case).
bool isImageName(const std::string& name);

/// Decodes a whole image from memory; grey becomes RGB, alpha and further channels are left out,
/// and one whose header says that it lies or stands on its head (Radiance's "+X 256 -Y 256") is
/// turned upright.
/// `name` tells the format by its extension and stands in messages.
/// Throws std::runtime_error for anything that is not a whole image.
EncodedImage decodeImage(std::span<const char> bytes, const std::string& name,
                         const ReadLimits& limits = {});

struct ImageSize {
    int width = 0;
    int height = 0;
};

/// What an image's header declares. Throws as decodeImage().
ImageSize imageSize(std::span<const char> bytes, const std::string& name,
                    const ReadLimits& limits = {});

/// Throws std::runtime_error for a size that no photograph of a material has, or that no file of
/// `bytes` bytes can hold, or above the limits, before memory is taken for it.
void checkImageSize(int width, int height, std::size_t bytes, const std::string& name,
                    const ReadLimits& limits);

/// True where the format's values are linear already (OpenEXR, Radiance HDR, PFM).
bool isLinearFormat(const std::string& name);

}  // namespace abrdf
