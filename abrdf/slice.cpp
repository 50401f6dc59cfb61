// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/slice.h"

#include <cmath>

namespace abrdf {

namespace {

LightAndView axialSample(const Slice& slice, int k) {
    const Radians phiLight = slice.start + 2 * kPi * k / slice.count;
    return {{slice.thetaLight, wrappedAzimuth(phiLight)},
            {slice.thetaView, wrappedAzimuth(phiLight + slice.offset)}};
}

/// Two half turns, each crowded about its middle: design, estimator.md section 4.
LightAndView diagonalSample(const Slice& slice, int k) {
    const double x = 2.0 * k / slice.count;
    const double h = x - std::floor(x);
    const double u = h <= 0.5 ? 2 * h : 2 * (h - 1);
    const Radians phiView = (kPi + slice.offset) / 2 + (x >= 1 ? kPi : 0) +
                            std::copysign(std::pow(std::abs(u), slice.power), u) * kPi / 2;
    return {{slice.thetaLight, wrappedAzimuth(slice.offset - phiView)},
            {slice.thetaView, wrappedAzimuth(phiView)}};
}

}  // namespace

std::vector<LightAndView> samplesOf(const Slice& slice) {
    std::vector<LightAndView> samples;
    for (int k = 0; k < slice.count; ++k) {
        samples.push_back(slice.kind == SliceKind::kAxial ? axialSample(slice, k)
                                                          : diagonalSample(slice, k));
    }
    return samples;
}

}  // namespace abrdf
