// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/environment_map.h"
#include "stages/preview/camera.h"

#include <vector>

namespace abrdf {

/// A distant light.
struct Light {
    Imath::V3d direction;    ///< Towards it, unit length, in the scene's frame.
    Rgb strength;            ///< Irradiance over pi: a white Lambertian that faces it shows this.
    double softness = 0.02;  ///< Sine of its angular radius: how soft its shadows are.
};

/// The direction in which the point (x, y) of a map lies, in pixels from its upper left corner.
Imath::V3d directionInMap(const EnvironmentMap& map, double x, double y);

/// The map as at most `count` lights, each with all the energy of a rectangle of its pixels, in
/// the direction of their centroid. Rectangles are halved where energy times squared extent is
/// largest, so that many stand where the light is; what is not finite or negative counts as 0.
std::vector<Light> lightsOf(const EnvironmentMap& map, int count);

/// Turns lights about the vertical axis, from +z towards +x.
std::vector<Light> turned(std::vector<Light> lights, Radians azimuth);

/// What a white Lambertian with this normal shows.
Rgb whiteShows(const std::vector<Light>& lights, const Imath::V3d& normal);

/// Scales lights so that the brightest white Lambertian among all orientations has luminance 1.
void normalize(const std::vector<std::vector<Light>*>& lights);

}  // namespace abrdf
