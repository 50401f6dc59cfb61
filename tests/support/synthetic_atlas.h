// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"

#include <functional>

namespace abrdf {

/// An angular atlas in linear Rec.709 whose values are value(pair, texel x, texel y).
Atlas syntheticAtlas(const AngularGrid& grid, int width, int height,
                     const std::function<Rgb(const LightAndView& pair, int x, int y)>& value,
                     Cosine cosine = Cosine::kKept);

/// A white Lambertian times `albedo`, and a glossy lobe of half-width `width` radians around the
/// mirror direction, `gloss` high.
Rgb lambertianWithGloss(const LightAndView& pair, Rgb albedo, double gloss, double width);

/// Writes it as float.
void writeAtlas(const std::filesystem::path& path, const Atlas& atlas);

}  // namespace abrdf
