// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <ImathVec.h>

namespace abrdf {

/// Unit vector towards (azimuth, elevation) in the scene's frame: x right, y up, z towards the
/// viewer; azimuth from +z towards +x.
Imath::V3d vectorFromAzimuthElevation(Radians azimuth, Radians elevation);

/// Where the picture is taken from. It looks at the origin.
struct CameraOptions {
    Radians azimuth = 0;
    Radians elevation = 0;                         ///< -90 to 90 degrees.
    Radians fieldOfView = radiansFromDegrees(25);  ///< Of the shorter side, 1 to 120 degrees.
    double reach = 1;  ///< Radius of the sphere around the origin that fits into the picture.
};

struct Ray {
    Imath::V3d origin;
    Imath::V3d direction;  ///< Unit length.
};

class Camera {
  public:
    /// Throws std::invalid_argument where an option is out of its range.
    Camera(const CameraOptions& options, int width, int height);

    /// Through the point (x, y) of the picture, in pixels from its upper left corner.
    Ray rayThrough(double x, double y) const;

  private:
    Imath::V3d position_;
    Imath::V3d right_;
    Imath::V3d up_;
    Imath::V3d forward_;
    double halfWidth_ = 0;
    double halfHeight_ = 0;
    double width_ = 0;
    double height_ = 0;
};

}  // namespace abrdf
