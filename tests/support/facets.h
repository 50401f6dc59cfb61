// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/analytic_material.h"

namespace abrdf {

inline Imath::V3f unit(double thetaDegrees, double phiDegrees) {
    return Imath::V3f(
        vectorFromDirection({radiansFromDegrees(thetaDegrees), radiansFromDegrees(phiDegrees)}));
}

/// Facets in the plane.
inline AnalyticMaterial flat(const Facet& facet) {
    AnalyticMaterial material;
    material.facets = {facet};
    return material;
}

inline Facet lambertian(float albedo) {
    Facet facet;
    facet.diffuse.albedo = albedo;
    return facet;
}

/// A lobe alone that reflects all light.
inline Facet mirror(LobeShape shape, float roughnessX, float roughnessY) {
    Facet facet;
    facet.lobes[0].strength = 1;
    facet.lobes[0].shape = shape;
    facet.lobes[0].fresnel = {1, 1, 5};
    facet.lobes[0].roughnessX = roughnessX;
    facet.lobes[0].roughnessY = roughnessY;
    return facet;
}

}  // namespace abrdf
