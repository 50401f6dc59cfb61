// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/preview/light.h"
#include "stages/preview/material.h"
#include "stages/preview/surface.h"

#include <span>
#include <vector>

namespace abrdf {

/// What lights contribute through one light direction of the material's grid: as the radiance of
/// a point is linear in the stored values, it is the sum over lights of strength x value.
struct LightShare {
    std::size_t light = 0;
    Rgb strength;
};

/// The shares of one light as seen from `frame`, `factor` times, added to `shares`.
void addShares(const Material& material, const Frame& frame, const Light& light, double factor,
               std::vector<LightShare>& shares);

/// Many lights, projected onto the material's light directions at each node of a surface: the
/// exact integral of the interpolated material there, interpolated between the nodes. Nodes that
/// face away from the camera are left out.
class GatheredLight {
  public:
    GatheredLight(const Material& material, const Surface& surface,
                  const std::vector<Light>& lights, const CameraOptions& camera);

    /// The strengths at (u, v), one a light direction.
    void at(double u, double v, std::span<Rgb> strengths) const;

  private:
    struct Place {
        std::size_t before, after;
        float t;
    };
    static Place placeOf(double x, int nodes, bool closes);

    std::size_t lightCount_;
    int wide_;
    int high_;
    bool closes_;
    ZeroedVector<Rgb> strengths_;  ///< Node after node.
};

}  // namespace abrdf
