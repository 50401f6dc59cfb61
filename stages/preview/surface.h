// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/preview/camera.h"

#include <memory>
#include <optional>

namespace abrdf {

/// The material's own axes at a point: x along the rows of its images, y up their columns.
struct Frame {
    Imath::V3d x;
    Imath::V3d y;
    Imath::V3d normal;

    /// A direction of the scene as the material sees it.
    Imath::V3d local(const Imath::V3d& v) const { return {v ^ x, v ^ y, v ^ normal}; }
};

struct SurfacePoint {
    Imath::V3d position;
    Frame frame;
    double u = 0;  ///< Place on the surface, 0 .. 1, left to right.
    double v = 0;  ///< 0 .. 1, top to bottom.
    double distance = 0;
};

/// A shape that wears the material.
class Surface {
  public:
    virtual ~Surface() = default;

    /// The first point that the ray meets.
    virtual std::optional<SurfacePoint> hit(const Ray& ray) const = 0;

    /// The frame at (u, v); smooth between the nodes of nodesWide() x nodesHigh().
    virtual Frame frameAt(double u, double v) const = 0;

    /// Share of a distant light in `direction` that the shape itself lets through to a point, 0 ..
    /// 1; `softness`: the sine of the light's angular radius.
    virtual double lightReaching(const SurfacePoint& point, const Imath::V3d& direction,
                                 double softness) const;

    /// The same, coarsely, for light from everywhere: at a node.
    virtual double skyReaching(double u, double v, const Imath::V3d& direction) const;

    /// How finely frame and sky vary over u and v.
    virtual int nodesWide() const { return 1; }
    virtual int nodesHigh() const { return 1; }
    virtual bool closesInU() const { return false; }

    /// Length of u over that of v, so that texels are squares.
    virtual double aspect() const { return 1; }
};

/// A sphere of radius 1; u is longitude, v latitude from the north pole down.
std::unique_ptr<Surface> makeSphere();

/// The square of side 1.5 that lies on the ground.
std::unique_ptr<Surface> makePlane();

/// A cloth that falls from a small dome to the ground in folds.
std::unique_ptr<Surface> makeDrape();

}  // namespace abrdf
