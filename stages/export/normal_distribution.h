// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <functional>
#include <vector>

namespace abrdf {

/// Nodes of a table over directions as RGL files space them: elevation (pi/2) x^2 along a row,
/// azimuth -pi .. pi from row to row. Two rows: nothing depends on the azimuth.
struct DirectionNodes {
    std::size_t thetas = 128;  ///< 2 ..
    std::size_t phis = 2;      ///< 2 .., the first and the last row are the same azimuth.

    Direction at(std::size_t theta, std::size_t phi) const;
};

/// A distribution D of micronormals, 1/sr, with integral of D cos(theta) 1, and the projected area
/// sigma(w) = integral of D(m) max(0, <w, m>) that they show to each direction.
struct NormalDistribution {
    DirectionNodes nodes;
    std::vector<double> density;  ///< Row by row.
    std::vector<double> area;     ///< At the same nodes.
};

/// The distribution whose single scattering shows `retro(m) = f(m, m) cos(theta_m)` to a viewer in
/// the light's own direction: D(m) ~ retro(m) sigma(m), found by power iterations [Dupuy et al.
/// 2015, "Extracting microfacet-based BRDF parameters from arbitrary materials with power
/// iterations"]. A thousandth of it is a Lambertian's share, so that it is nowhere 0.
/// phis: rows, 2 where the material is isotropic. retro: not negative; asked once a node.
NormalDistribution distributionFromRetro(std::size_t phis,
                                         const std::function<double(Direction m)>& retro);

}  // namespace abrdf
