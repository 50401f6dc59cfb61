// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/abrdf_tile.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace abrdf {

struct SeenOptions {
    double exposure = 1;           ///< Factor on the values, > 0; unitless.
    double texelsPerDegree = 60;   ///< Of the visual field, as the images are looked at; > 0.
    bool isPeriodic = false;       ///< Do the images' edges join?
    std::size_t mostImages = 512;  ///< As many, evenly spread over those that are compared.
};

/// How far whole images are from their measurement to the eye.
struct SeenMeasures {
    double sCielab = 0;  ///< Mean S-CIELAB colour difference (Zhang and Wandell 1996).
    double ssim = 1;     ///< Mean structural similarity of sRGB luma (Wang et al. 2004), -1 .. 1.
    std::size_t images = 0;
};

/// The images, width x height texels each, of pairs whose flag is not 0; scene-linear Rec.709,
/// shown as an sRGB display does. Texels that `truth` lacks (not finite) count as equal in what
/// surrounds them, and not themselves.
SeenMeasures measureSeenImages(const AbrdfTile& truth, const AbrdfTile& reconstruction, int width,
                               int height, std::span<const std::uint8_t> mask,
                               const SeenOptions& options);

}  // namespace abrdf
