// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <ImathVec.h>

namespace abrdf {

/// Light and view in the frame of a surface (z its normal), both above it, and what its lobes ask
/// of them. Cosines that divide are kept above 1e-3, so that grazing directions give numbers.
struct LocalPair {
    LocalPair(const Imath::V3f& localLight, const Imath::V3f& localView);

    Imath::V3f light, view, half;
    float cosLight, cosView;  ///< To the normal, 1e-3 .. 1.
    float cosHalfToLight;     ///< Of the difference angle, 0 .. 1.
    float cosBetween;         ///< Between light and view, -1 .. 1.
};

/// F(c) = normal + (grazing - normal) (1 - c)^power; power 5 is [Schlick 1994].
struct Fresnel {
    float normal = 0.04F;  ///< Reflectance seen along the normal, 0 .. 1.
    float grazing = 1;     ///< Reflectance at grazing, 0 .. 1.
    float power = 5;       ///< Larger keeps the rise nearer to grazing; > 0.
};

enum class LobeShape {
    kGgx,       ///< [Walter et al. 2007, eq. 33]; anisotropic after [Heitz 2014].
    kBeckmann,  ///< Gaussian in slopes [Walter et al. 2007, eq. 25].
    kLongTail,  ///< GGX with another exponent [Burley 2012]: more light far from the highlight.
};

/// The highlight of a rough mirror.
struct Lobe {
    float strength = 0;  ///< Factor on everything; 0 is no lobe.
    Fresnel fresnel;
    float roughnessX = 0.3F;  ///< Alpha of GGX and Beckmann, > 0, along ...
    float roughnessY = 0.3F;  ///< ... and across `azimuth`.
    Radians azimuth = 0;
    LobeShape shape = LobeShape::kGgx;
    float tail = 2;  ///< Of kLongTail: exponent, > 1; 2 is GGX, smaller a longer tail.
};

/// A lobe with everything that does not depend on the directions worked out.
class PreparedLobe {
  public:
    explicit PreparedLobe(const Lobe& lobe);

    /// pi D G F / (4 cos_i cos_o): pi times the BRDF.
    float reflectanceFactor(const LocalPair& pair) const;

  private:
    float distribution(const Imath::V3f& half) const;
    float smithLambda(const Imath::V3f& direction) const;
    float fresnel(float cosine) const;

    Lobe lobe_;
    float cos_, sin_;  // of the azimuth
    float inverseRoughnessX2_, inverseRoughnessY2_;
    float peak_;  // pi D(normal)
};

}  // namespace abrdf
