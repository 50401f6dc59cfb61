// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/analytic_material.h"
#include "abrdf/direction.h"
#include "color/rgb.h"

#include <functional>
#include <string>
#include <vector>

namespace abrdf {

/// A material whose value is known at any pair of directions: reflectance factor times
/// cos(theta_i), scene-linear Rec.709.
struct StressMaterial {
    std::string name;
    std::function<Rgb(const LightAndView&)> value;
};

/// A grey analytic material and the colour it has.
struct ColoredPart {
    AnalyticMaterial material;
    Rgb color;
};

/// Their sum.
StressMaterial analyticStressMaterial(std::string name, const std::vector<ColoredPart>& parts);

/// Lambert's law in a colour.
ColoredPart lambertPart(Rgb color);

/// A GGX highlight; roughness: alpha along x and y; normal: reflectance along the normal.
ColoredPart highlightPart(float roughnessX, float roughnessY, float normal, Rgb color);

/// What stands for all materials where no input is given: matt, plastic, satin, metal, velvet and
/// a weave, all known in closed form.
std::vector<StressMaterial> stressMaterials();

/// The same material after it was turned about its normal.
StressMaterial turned(const StressMaterial& material, Radians azimuth);

}  // namespace abrdf
