// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "abrdf/microfacet.h"
#include "color/rgb.h"

#include <span>
#include <vector>

namespace abrdf {

/// A diffuse body and one anisotropic GGX lobe [Walter et al. 2007]:
///     B = cos(theta_i) (diffuse + specular pi D G F / (4 cos_i cos_o))
/// with F = 1 + (grazing - 1) (1 - c)^5, c the cosine of the difference angle.
struct MicrofacetFit {
    Rgb diffuse;
    Rgb specular;
    double roughnessX = 0.3;  ///< Along ...
    double roughnessY = 0.3;  ///< ... and across `azimuth`; 0.01 .. 1.
    Radians azimuth = 0;
    double grazing = 1;  ///< How much more is reflected at grazing than along the normal, 1 .. 50.
    double condition = 1;  ///< Of the last step's normal equations, damped.

    Lobe lobe() const;
};

/// Least squares in cube roots, as a display shows them, from several roughnesses: Levenberg and
/// Marquardt over the lobe's four numbers, of which both colours follow in closed form, none
/// negative. The unit of the values is that of the colours.
MicrofacetFit fitMicrofacet(const std::vector<LightAndView>& pairs, std::span<const Rgb> values);

/// The same with the lobe in double precision too: its slow twin.
MicrofacetFit fitMicrofacetInDouble(const std::vector<LightAndView>& pairs,
                                    std::span<const Rgb> values);

}  // namespace abrdf
