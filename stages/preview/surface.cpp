// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/surface.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

double Surface::lightReaching(const SurfacePoint& /*point*/, const Imath::V3d& /*direction*/,
                              double /*softness*/) const {
    return 1;
}

double Surface::skyReaching(double /*u*/, double /*v*/, const Imath::V3d& /*direction*/) const {
    return 1;
}

namespace {

class Sphere : public Surface {
  public:
    std::optional<SurfacePoint> hit(const Ray& ray) const override {
        // |o + t d| = 1
        const double half = ray.origin ^ ray.direction;
        const double discriminant = half * half - ray.origin.length2() + 1;
        if (discriminant < 0) return std::nullopt;
        SurfacePoint point;
        point.distance = -half - std::sqrt(discriminant);
        if (point.distance <= 0) return std::nullopt;
        point.position = ray.origin + ray.direction * point.distance;
        const Imath::V3d& n = point.position;
        point.u = std::atan2(n.x, n.z) / (2 * kPi) + 0.5;
        point.v = std::acos(std::clamp(n.y, -1.0, 1.0)) / kPi;
        point.frame = frameAt(point.u, point.v);
        return point;
    }

    Frame frameAt(double u, double v) const override {
        const double longitude = (u - 0.5) * 2 * kPi;
        const double latitude = (0.5 - v) * kPi;
        const Imath::V3d normal = vectorFromAzimuthElevation(longitude, latitude);
        const Imath::V3d x(std::cos(longitude), 0, -std::sin(longitude));
        return {x, normal.cross(x), normal};
    }

    int nodesWide() const override { return 120; }
    int nodesHigh() const override { return 61; }
    bool closesInU() const override { return true; }
    double aspect() const override { return 2; }
};

class Plane : public Surface {
  public:
    std::optional<SurfacePoint> hit(const Ray& ray) const override {
        if (!(ray.direction.y < 0)) return std::nullopt;
        SurfacePoint point;
        point.distance = -ray.origin.y / ray.direction.y;
        if (point.distance <= 0) return std::nullopt;
        point.position = ray.origin + ray.direction * point.distance;
        point.u = point.position.x / kSide + 0.5;
        point.v = point.position.z / kSide + 0.5;
        if (point.u < 0 || point.u > 1 || point.v < 0 || point.v > 1) return std::nullopt;
        point.frame = frameAt(point.u, point.v);
        return point;
    }

    Frame frameAt(double /*u*/, double /*v*/) const override {
        return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    }

  private:
    static constexpr double kSide = 1.5;
};

}  // namespace

std::unique_ptr<Surface> makeSphere() {
    return std::make_unique<Sphere>();
}

std::unique_ptr<Surface> makePlane() {
    return std::make_unique<Plane>();
}

}  // namespace abrdf
