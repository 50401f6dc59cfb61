// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "abrdf/microfacet.h"

#include <ImathVec.h>

#include <array>
#include <vector>

namespace abrdf {

/// A matt body: Lambert, and its corrections, which multiply.
struct Diffuse {
    float albedo = 0;               ///< 0 .. 1; 0 is none.
    float orenNayarSigma = 0;       ///< Deviation of slopes in radians [Oren, Nayar 1994]; 0: flat.
    float minnaertExponent = 0;     ///< Factor (cos_i cos_o)^exponent [Minnaert 1941].
    float lommelSeeligerShare = 0;  ///< Share of 1 / (cos_i + cos_o), as of dust; 0 .. 1.
};

/// Cloth with upright fibres, bright at its rims [Ashikhmin et al. 2000, velvet].
struct Velvet {
    float strength = 0;  ///< 0 is none.
    float sigma = 0.3F;  ///< Width about the surface's plane; > 0.
};

/// Light scattered by a cylinder into the cone of its mirror direction [Marschner et al. 2003].
struct Fibre {
    float strength = 0;  ///< 0 is none.
    Radians azimuth = 0;
    float width = 0.2F;      ///< Of the cone, radians, > 0.
    float shift = 0;         ///< Of the cone by the fibre's scales, radians.
    float azimuthShare = 0;  ///< Share of the fall-off around the fibre; 0 .. 1.
    float grazingShare = 0;  ///< Share that brightens at grazing, as dense fibres do; 0 .. 1.
};

/// Light sent back to where it came from.
struct RetroReflection {
    float strength = 0;  ///< 0 is none.
    float width = 0.1F;  ///< Falls to 1/e where the cosine between light and view is 1 - width.
};

/// One plane of a rough surface, or one piece of a thread: where it looks, and what it scatters.
struct Facet {
    Radians tilt = 0;     ///< Angle between its normal and the surface's, 0 .. pi/2.
    Radians azimuth = 0;  ///< Where it is tilted to.
    float weight = 1;     ///< Share of the surface's area; only ratios count.
    float groove = 0;     ///< How much its neighbours mask and shadow it: 0 not, 1 as a V-groove.

    Diffuse diffuse;
    std::array<Lobe, 2> lobes;
    Velvet velvet;
    Fibre fibre;
    RetroReflection retro;
};

/// `facet` after its surface was turned by `angle` about the normal.
Facet turned(Facet facet, Radians angle);

/// A facet's scattering in its own frame, with everything that does not depend on the directions
/// worked out.
class PreparedFacet {
  public:
    explicit PreparedFacet(const Facet& facet);

    /// pi times the BRDF, times the cosine to the light: a white Lambertian lit from its normal
    /// gives 1. Both directions in the facet's frame; 0 where either is not above its plane.
    float evaluate(const Imath::V3f& light, const Imath::V3f& view) const;

  private:
    float diffuse(const LocalPair& pair) const;
    float velvet(const LocalPair& pair) const;
    float fibre(const LocalPair& pair) const;
    float retro(const LocalPair& pair) const;

    Facet facet_;
    std::vector<PreparedLobe> lobes_;  // those that are there
    float orenNayarA_, orenNayarB_;    // [Oren, Nayar 1994, eq. 30]
    float fibreCos_, fibreSin_;        // of the fibre's azimuth
};

}  // namespace abrdf
