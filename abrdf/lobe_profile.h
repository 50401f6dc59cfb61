// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"

#include <array>
#include <cstddef>

namespace abrdf {

/// How a material's reflectance falls with the half angle, on average over all pairs: what makes a
/// highlight round. Between directions 15 degrees apart a highlight of a few degrees cannot be
/// interpolated; its ratio to this profile can: B = p(target) * sum of weight * B(node) / p(node),
/// which is still exact at the nodes, and linear interpolation where the profile is flat.
class LobeProfile {
  public:
    /// Logarithms are kept at these places: evenly spread in ln(half angle in degrees + 2), as
    /// highlights vary, from 0 to 90 degrees. Between them runs a uniform cubic B-spline, flat at
    /// the half angle 0: no kink shows as a ring.
    static constexpr std::size_t kPlaces = 32;

    /// Of the mean over all texels. The profile never rises; that of a black or matt atlas is 1
    /// everywhere: no fall by half within 15 degrees.
    explicit LobeProfile(const Atlas& atlas);

    /// p at a half angle, 0 .. pi / 2; > 0 and at most 1.
    double at(Radians halfAngle) const;

    /// The spline's coefficients, of ln p.
    const std::array<double, kPlaces>& logarithms() const { return logarithms_; }

  private:
    std::array<double, kPlaces> logarithms_{};
};

/// The angle between the normal and the half vector of two unit vectors, z along the normal.
Radians halfAngleOf(const Imath::V3d& light, const Imath::V3d& view);

}  // namespace abrdf
