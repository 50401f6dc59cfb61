// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/brdf_comparison.h"

#include "abrdf/rgl_table.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr int kX = 400;  ///< Elevations of the micronormal.
constexpr int kY = 60;   ///< Its azimuths.

/// Sums over the lights of a view; values times solid angle, which hold the light's cosine.
struct ViewSums {
    double truth = 0;
    double found = 0;
    double difference = 0;  ///< Weighted, up to 75 degrees.
    double weighted = 0;
};

ViewSums sumsOf(Direction view, const BrdfTable& truth, const BrdfTable& found) {
    const Imath::V3d in = vectorFromDirection(view);
    ViewSums sums;
    for (int i = 0; i < kX * kY; ++i) {
        const double x = (i % kX + 0.5) / kX;
        const Direction m = {thetaFromRgl(x), 2 * kPi * (i / kX + 0.5) / kY};
        const double cosine = in.dot(vectorFromDirection(m));
        const Imath::V3d out = 2 * cosine * vectorFromDirection(m) - in;
        if (cosine <= 0 || out.z <= 0) continue;
        const double angle = 4 * cosine * 2 * kPi * kPi * x * std::sin(m.theta) / (kX * kY);
        const LightAndView pair = {directionFromVector(out), view};
        const double a = angle / kPi * static_cast<double>(truth.evaluate(pair).g);
        const double b = angle / kPi * static_cast<double>(found.evaluate(pair).g);
        sums.truth += a;
        sums.found += b;
        if (out.z < std::cos(radiansFromDegrees(75))) continue;
        sums.difference += out.z * std::abs(a - b);
        sums.weighted += out.z * a;
    }
    return sums;
}

}  // namespace

BrdfComparison compareBrdfs(const BrdfTable& truth, const BrdfTable& found) {
    BrdfComparison result;
    ViewSums all;
    for (const double degrees : {4.0, 21.0, 37.0, 55.0, 73.0}) {
        const Direction view = {radiansFromDegrees(degrees), 0.7};
        const ViewSums sums = sumsOf(view, truth, found);
        all.truth += sums.truth;
        all.found += sums.found;
        all.difference += sums.difference;
        all.weighted += sums.weighted;
        result.energy = std::max(result.energy, std::abs(sums.found / sums.truth - 1));
        result.reflectance = std::max(result.reflectance, sums.found);
        result.trueReflectance = std::max(result.trueReflectance, sums.truth);
        const LightAndView mirror = {{view.theta, view.phi + kPi}, view};
        const double ratio = static_cast<double>(found.evaluate(mirror).g) /
                             static_cast<double>(truth.evaluate(mirror).g);
        result.highlight = std::max(result.highlight, std::abs(ratio - 1));
    }
    result.error = all.difference / all.weighted;
    result.allEnergy = std::abs(all.found / all.truth - 1);
    return result;
}

}  // namespace abrdf
