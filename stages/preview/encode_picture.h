// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/coded_picture.h"
#include "abrdf/picture.h"
#include "color/color_config.h"

#include <optional>

namespace abrdf {

struct EncodeOptions {
    double exposure = 1;            ///< Factor on the light before it is shown, > 0.
    std::optional<Rgb> background;  ///< Scene-linear, shown as it is; nothing: an alpha channel.
    int bits = 8;                   ///< 8 or 16.
    bool dither = true;  ///< Else codes are rounded, as for JPEG, which would smear the noise.
};

/// Codes of a display's 0 .. 1: value times 2^bits - 1, plus a threshold below 1 that depends on
/// pixel and channel alone, rounded down. The error is then unseen noise and no banding, right on
/// average; 0 and 1 stay exact.
std::uint16_t ditheredCode(float value, int bits, std::size_t pixel, int channel);

/// A picture as a display shows it: exposure, background, the display's transform, dithered codes.
CodedPicture encodePicture(const Picture& picture, const ColorTransform& toDisplay,
                           const EncodeOptions& options);

}  // namespace abrdf
