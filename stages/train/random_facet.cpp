// SPDX-License-Identifier: BSD-3-Clause
//
// The distributions of random facets.
#include "stages/train/random_facet.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

float asFloat(double value) {
    return static_cast<float>(value);
}

float roughness(double value) {
    return asFloat(std::clamp(value, kLeastRoughness, kMostRoughness));
}

Lobe randomLobe(Random& random) {
    Lobe lobe;
    const double alpha = random.logUniform(kLeastRoughness, 0.8);
    const double ratio = random.chance(0.5) ? std::exp(random.uniform(-1.6, 1.6)) : 1;
    lobe.strength = asFloat(random.uniform(0.1, 1));
    lobe.fresnel.normal = asFloat(random.logUniform(0.02, 0.95));
    lobe.fresnel.grazing = random.chance(0.6) ? 1 : asFloat(random.uniform());
    lobe.fresnel.power = random.chance(0.6) ? 5 : asFloat(random.uniform(1.5, 6));
    lobe.roughnessX = roughness(alpha * std::sqrt(ratio));
    lobe.roughnessY = roughness(alpha / std::sqrt(ratio));
    lobe.azimuth = random.chance(0.4) ? random.uniform(0, kPi) : 0;
    const double shape = random.uniform();
    lobe.shape = shape < 0.7    ? LobeShape::kGgx
                 : shape < 0.85 ? LobeShape::kBeckmann
                                : LobeShape::kLongTail;
    lobe.tail = asFloat(random.uniform(1.3, 2.5));
    return lobe;
}

Diffuse randomDiffuse(Random& random) {
    Diffuse diffuse;
    if (random.chance(0.85)) {
        diffuse.albedo =
            asFloat(random.chance(0.5) ? random.uniform(0, 0.7) : random.logUniform(0.005, 0.7));
    }
    if (!random.chance(0.5)) return diffuse;
    const double which = random.uniform();
    if (which < 0.4) {
        diffuse.orenNayarSigma = asFloat(random.uniform(0.1, 1.2));
    } else if (which < 0.8) {
        diffuse.minnaertExponent = asFloat(random.uniform(-0.4, 0.5));
    } else {
        diffuse.lommelSeeligerShare = asFloat(random.uniform(0.2, 1));
    }
    return diffuse;
}

Fibre randomFibre(Random& random) {
    Fibre fibre;
    fibre.strength = asFloat(random.logUniform(0.02, 1.5));
    fibre.azimuth = random.uniform(0, kPi);
    fibre.width = asFloat(random.logUniform(0.05, 0.5));
    fibre.shift = random.chance(0.5) ? asFloat(random.uniform(-0.3, 0.3)) : 0;
    fibre.azimuthShare = asFloat(random.uniform());
    fibre.grazingShare = asFloat(random.uniform());
    return fibre;
}

bool reflects(const Facet& facet) {
    return facet.diffuse.albedo > 0 || facet.lobes[0].strength > 0 || facet.velvet.strength > 0 ||
           facet.fibre.strength > 0;
}

}  // namespace

FacetKind randomFacetKind(Random& random) {
    const double which = random.uniform();
    if (which < 0.50) return FacetKind::kLobe;
    if (which < 0.70) return FacetKind::kTwoLobes;
    if (which < 0.80) return FacetKind::kVelvet;
    if (which < 0.95) return FacetKind::kFibre;
    return FacetKind::kDiffuse;
}

Facet randomFacet(FacetKind kind, Random& random) {
    Facet facet;
    facet.diffuse = randomDiffuse(random);
    switch (kind) {
        case FacetKind::kTwoLobes:
            facet.lobes[1] = randomLobe(random);
            [[fallthrough]];
        case FacetKind::kLobe:
            facet.lobes[0] = randomLobe(random);
            break;
        case FacetKind::kVelvet:
            facet.velvet.strength = asFloat(random.uniform(0.02, 0.4));
            facet.velvet.sigma = asFloat(random.uniform(0.15, 0.8));
            if (random.chance(0.3)) facet.lobes[0] = randomLobe(random);
            break;
        case FacetKind::kFibre:
            facet.fibre = randomFibre(random);
            if (random.chance(0.3)) facet.lobes[0] = randomLobe(random);
            break;
        case FacetKind::kDiffuse:
            facet.diffuse.albedo = std::max(facet.diffuse.albedo, 0.05F);
            break;
    }
    if (random.chance(0.12)) {
        facet.retro.strength = asFloat(random.uniform(0.02, 0.6));
        facet.retro.width = asFloat(random.logUniform(0.02, 0.6));
    }
    if (!reflects(facet)) facet.diffuse.albedo = 0.2F;
    return facet;
}

Facet isotropic(Facet facet) {
    facet.fibre = {};
    for (Lobe& lobe : facet.lobes) {
        lobe.roughnessX = lobe.roughnessY = std::sqrt(lobe.roughnessX * lobe.roughnessY);
        lobe.azimuth = 0;
    }
    if (!reflects(facet)) facet.diffuse.albedo = 0.3F;
    return facet;
}

}  // namespace abrdf
