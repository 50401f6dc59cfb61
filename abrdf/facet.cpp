// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/facet.h"

#include "abrdf/portable_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace abrdf {

using Imath::V3f;

namespace {

// About a tenth of the light that meets a fibre leaves it in the cone; times pi.
constexpr float kFibreNorm = 0.1F * std::numbers::pi_v<float>;

}  // namespace

Facet turned(Facet facet, Radians angle) {
    facet.azimuth += angle;
    for (Lobe& lobe : facet.lobes) lobe.azimuth += angle;
    facet.fibre.azimuth += angle;
    return facet;
}

PreparedFacet::PreparedFacet(const Facet& facet) : facet_(facet) {
    for (const Lobe& lobe : facet.lobes) {
        if (lobe.strength > 0) lobes_.emplace_back(lobe);
    }
    const float sigma2 = facet.diffuse.orenNayarSigma * facet.diffuse.orenNayarSigma;
    orenNayarA_ = 1 - 0.5F * sigma2 / (sigma2 + 0.33F);
    orenNayarB_ = 0.45F * sigma2 / (sigma2 + 0.09F);
    fibreCos_ = static_cast<float>(std::cos(facet.fibre.azimuth));
    fibreSin_ = static_cast<float>(std::sin(facet.fibre.azimuth));
}

float PreparedFacet::evaluate(const V3f& light, const V3f& view) const {
    if (light.z <= 0 || view.z <= 0) return 0;
    const LocalPair pair(light, view);
    float factor = 0;
    if (facet_.diffuse.albedo > 0) factor += diffuse(pair);
    for (const PreparedLobe& lobe : lobes_) factor += lobe.reflectanceFactor(pair);
    if (facet_.velvet.strength > 0) factor += velvet(pair);
    if (facet_.fibre.strength > 0) factor += fibre(pair);
    if (facet_.retro.strength > 0) factor += retro(pair);
    return factor * pair.cosLight;
}

float PreparedFacet::diffuse(const LocalPair& pair) const {
    const Diffuse& d = facet_.diffuse;
    float factor = d.albedo;
    if (d.orenNayarSigma > 0) {
        // sin(alpha) tan(beta) cos(phi_i - phi_o), alpha the larger theta and beta the smaller.
        const float sines = pair.light.x * pair.view.x + pair.light.y * pair.view.y;
        const float term = std::max(sines, 0.0F) / std::max(pair.cosLight, pair.cosView);
        factor *= orenNayarA_ + orenNayarB_ * term;
    }
    if (d.minnaertExponent != 0) {
        factor *= portable::pow(pair.cosLight * pair.cosView, d.minnaertExponent);
    }
    if (d.lommelSeeligerShare > 0) {
        const float s = d.lommelSeeligerShare;
        factor *= 1 - s + s / (pair.cosLight + pair.cosView);
    }
    return factor;
}

float PreparedFacet::velvet(const LocalPair& pair) const {
    // Half vectors in the plane are frequent: D = (1 + 4 exp(-cot^2 / sigma^2) / sin^4) / norm.
    const float cos2 = pair.half.z * pair.half.z;
    const float sin2 = std::max(1 - cos2, 1e-4F);
    const float sigma2 = facet_.velvet.sigma * facet_.velvet.sigma;
    const float upright = portable::exp(-cos2 / (sin2 * sigma2)) / (sin2 * sin2);
    const float distribution = (1 + 4 * upright) / (1 + 4 * sigma2);
    const float spread = pair.cosLight + pair.cosView - pair.cosLight * pair.cosView;
    return facet_.velvet.strength * distribution / (4 * spread);
}

float PreparedFacet::fibre(const LocalPair& pair) const {
    const Fibre& f = facet_.fibre;
    const V3f axis(fibreCos_, fibreSin_, 0);
    // Inclinations to the fibre's normal plane; the cone lies where they are opposite.
    const float sinLight = std::clamp(pair.light.dot(axis), -1.0F, 1.0F);
    const float sinView = std::clamp(pair.view.dot(axis), -1.0F, 1.0F);
    const float half = 0.5F * (portable::asin(sinLight) + portable::asin(sinView)) - f.shift;
    const float along = portable::exp(-0.5F * half * half / (f.width * f.width)) / f.width;

    // Around the fibre: the cosine of the angle between both directions, seen along the axis.
    const float across2 = (1 - sinLight * sinLight) * (1 - sinView * sinView);
    const float across = std::sqrt(std::max(across2, 0.0F));
    const float cosPhi = (pair.cosBetween - sinLight * sinView) / std::max(across, 1e-6F);
    const float cosHalfPhi = std::sqrt(std::clamp(0.5F * (1 + cosPhi), 0.0F, 1.0F));
    const float around = 1 - f.azimuthShare + f.azimuthShare * cosHalfPhi;

    // cos^2 of half the difference of the inclinations; the bound replaces the pole's infinity.
    const float cos2Difference = 0.5F * (1 + across + sinLight * sinView);
    const float grazing = f.grazingShare / std::max(pair.cosLight + pair.cosView, 0.1F);
    return f.strength * kFibreNorm * along * around / (cos2Difference + 0.05F) *
           (1 - f.grazingShare + grazing);
}

float PreparedFacet::retro(const LocalPair& pair) const {
    return facet_.retro.strength * portable::exp((pair.cosBetween - 1) / facet_.retro.width);
}

}  // namespace abrdf
