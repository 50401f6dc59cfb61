// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"

#include <vector>

namespace abrdf {

enum class SliceKind {
    kAxial,     ///< phi_v = phi_i + offset: light and sensor fixed, the sample turns.
    kDiagonal,  ///< phi_i = offset - phi_v: light and sensor move against each other.
};

/// A closed line of samples through one subspace (theta_i, theta_v).
struct Slice {
    SliceKind kind = SliceKind::kAxial;
    Radians thetaLight = 0;
    Radians thetaView = 0;
    Radians offset = 0;
    int count = 1;  ///< Of samples. Diagonal ones best odd: even ones repeat azimuth differences.
    Radians start = 0;  ///< Axial: phi_i of the first sample. A diagonal starts at the mirror.
    double power = 1;   ///< Diagonal: above 1 crowds samples about the mirror and its opposite.
};

/// The samples in their order along the slice; azimuths in 0 .. 2 pi.
std::vector<LightAndView> samplesOf(const Slice& slice);

}  // namespace abrdf
