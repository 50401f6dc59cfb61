// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abrdf {

Imath::V3d vectorFromAzimuthElevation(Radians azimuth, Radians elevation) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            std::cos(elevation) * std::cos(azimuth)};
}

Camera::Camera(const CameraOptions& options, int width, int height)
    : width_(width), height_(height) {
    const double degrees = degreesFromRadians(options.fieldOfView);
    if (!(degrees >= 1 && degrees <= 120)) {
        throw std::invalid_argument("the field of view goes from 1 to 120 degrees");
    }
    if (!(std::abs(options.elevation) <= kPi / 2 + 1e-9) || !std::isfinite(options.azimuth)) {
        throw std::invalid_argument("the camera's elevation goes from -90 to 90 degrees");
    }
    constexpr double kMargin = 1.06;  // Around that sphere.
    const Imath::V3d towards = vectorFromAzimuthElevation(options.azimuth, options.elevation);
    position_ = towards * (kMargin * options.reach / std::sin(options.fieldOfView / 2));
    forward_ = -towards;
    right_ = {std::cos(options.azimuth), 0, -std::sin(options.azimuth)};
    up_ = right_.cross(forward_);
    const double half = std::tan(options.fieldOfView / 2);
    const double shorter = std::min(width_, height_);
    halfWidth_ = half * width_ / shorter;
    halfHeight_ = half * height_ / shorter;
}

Ray Camera::rayThrough(double x, double y) const {
    const double right = (2 * x / width_ - 1) * halfWidth_;
    const double up = (1 - 2 * y / height_) * halfHeight_;
    return {position_, (forward_ + right_ * right + up_ * up).normalized()};
}

}  // namespace abrdf
