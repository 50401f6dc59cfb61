// SPDX-License-Identifier: BSD-3-Clause
//
// `microfacet` with its lobe in double precision: derivatives by differences of floats are what a
// narrow or undetermined lobe makes too much of.
#include "stages/reconstruct/double_lobe.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

double DoubleLobe::reflectanceFactor(const LightAndView& pair) const {
    const Imath::V3d light(vectorFromDirection(pair.light));
    const Imath::V3d view(vectorFromDirection(pair.view));
    const Imath::V3d sum = light + view;
    const double length = sum.length();
    const Imath::V3d half = length > 1e-5 ? sum / length : Imath::V3d(0, 0, 1);
    const double c = std::cos(fit_.azimuth);
    const double s = std::sin(fit_.azimuth);
    const auto along = [&](const Imath::V3d& v) { return c * v.x + s * v.y; };
    const auto across = [&](const Imath::V3d& v) { return c * v.y - s * v.x; };
    const double ax = fit_.roughnessX;
    const double ay = fit_.roughnessY;
    const double t =
        std::pow(along(half) / ax, 2) + std::pow(across(half) / ay, 2) + std::pow(half.z, 2);
    const double distribution = 1 / (ax * ay * t * t);  // pi D [Walter et al. 2007]
    const auto lambda = [&](const Imath::V3d& v) {      // [Heitz 2014]
        const double tan2 =
            (std::pow(along(v) * ax, 2) + std::pow(across(v) * ay, 2)) / std::max(v.z * v.z, 1e-6);
        return 0.5 * (std::sqrt(1 + tan2) - 1);
    };
    const double cosine = std::clamp(light.dot(half), 0.0, 1.0);
    const double fresnel = 1 + (fit_.grazing - 1) * std::pow(std::max(1 - cosine, 1e-6), 5);
    return distribution * fresnel / (1 + lambda(light) + lambda(view)) /
           (4 * std::max(light.z, 1e-3) * std::max(view.z, 1e-3));
}

TwinAnswer microfacetTwin(const ReconstructionTask& task) {
    const MicrofacetFit fit = fitMicrofacetInDouble(task.samples.directions, task.mean);
    const DoubleLobe lobe(fit);
    TwinAnswer twin;
    twin.condition = fit.condition;
    for (const LightAndView& pair : pairsOf(task.output)) {
        const double cosine = std::max(std::cos(pair.light.theta), 0.0);
        const double shine = lobe.reflectanceFactor(pair);
        const auto channel = [&](float diffuse, float specular) {
            return cosine * (static_cast<double>(diffuse) + shine * static_cast<double>(specular));
        };
        twin.abrdf.push_back({channel(fit.diffuse.r, fit.specular.r),
                              channel(fit.diffuse.g, fit.specular.g),
                              channel(fit.diffuse.b, fit.specular.b)});
    }
    return twin;
}

}  // namespace abrdf
