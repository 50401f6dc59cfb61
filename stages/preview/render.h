// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/picture.h"
#include "abrdf/progress.h"
#include "stages/preview/light.h"
#include "stages/preview/material.h"
#include "stages/preview/surface.h"

#include <vector>

namespace abrdf {

/// What is rendered. Colours of lights and material are in one scene-linear space.
struct Scene {
    const Surface* surface = nullptr;
    CameraOptions camera;
    std::vector<Light> lights;  ///< Evaluated exactly at every point, with their shadows.
    std::vector<Light> sky;     ///< Many; gathered at the surface's nodes and interpolated.
    double tiles = 1;           ///< How often the material repeats over v, > 0.
};

/// Renders width x height pixels. Edges are sampled 16 times, textured pixels 4 times.
/// The same bits for every number of threads. Throws std::invalid_argument for sizes outside
/// 1 .. 16384 and a camera that is none.
Picture render(const Material& material, const Scene& scene, int width, int height,
               const ProgressSink& progress);

/// Radiance at one point, every light of the scene evaluated there: the slow twin of render().
Rgb radianceAt(const Material& material, const Scene& scene, const SurfacePoint& point,
               const Imath::V3d& towardsCamera);

}  // namespace abrdf
