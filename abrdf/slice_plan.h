// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <string>
#include <vector>

namespace abrdf {

/// The eight slices of the poster: two in each of four subspaces (theta_i, theta_v), every number
/// open. Axial: phi_v = phi_i + alpha (light and sensor fixed, the sample turns). Diagonal:
/// phi_i = 2 pi - phi_v + alpha (light and sensor move against each other).
struct SlicePlan {
    std::string name = "poster";
    std::vector<Radians> elevations = {radiansFromDegrees(30), radiansFromDegrees(75)};
    Radians alpha = radiansFromDegrees(90);  ///< The slices' offset; 90 measured best (method.md).
    int axialCount = 24;     ///< Samples of an axial slice, 1 .. 360, evenly in phi_i.
    int diagonalCount = 27;  ///< Samples of a diagonal slice, 1 .. 360, evenly in phi_v.

    /// Subspace s has theta_i = elevations[s / n], theta_v = elevations[s % n], n elevations.
    std::size_t subspaceCount() const { return elevations.size() * elevations.size(); }
    Radians thetaLight(std::size_t subspace) const {
        return elevations[subspace / elevations.size()];
    }
    Radians thetaView(std::size_t subspace) const {
        return elevations[subspace % elevations.size()];
    }

    std::size_t samplesPerSubspace() const {
        return static_cast<std::size_t>(axialCount) + static_cast<std::size_t>(diagonalCount);
    }

    /// All samples: subspace by subspace, in each the axial slice, then the diagonal one.
    std::vector<LightAndView> samples() const;
};

/// "poster", or "poster:N" with at most N samples shared out in the poster's proportion.
/// Throws std::invalid_argument for an unknown name or an N below 8 (one sample a slice).
SlicePlan slicePlanFromName(const std::string& name);

/// Throws std::invalid_argument, saying which number is wrong: an elevation outside 0 .. 90
/// degrees, two equal ones, a count outside 1 .. 360, an alpha that is not finite.
void checkPlan(const SlicePlan& plan);

}  // namespace abrdf
