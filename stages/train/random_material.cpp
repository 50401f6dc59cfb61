// SPDX-License-Identifier: BSD-3-Clause
//
// The distributions of the random materials; of their facets in random_facet.cpp.
#include "stages/train/random_material.h"

#include "stages/train/random_facet.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

float asFloat(double value) {
    return static_cast<float>(value);
}

/// Shares of a whole, each order of them as likely: Dirichlet with this concentration, 1 or 2.
std::vector<float> randomShares(std::size_t count, int concentration, Random& random) {
    std::vector<float> shares;
    for (std::size_t k = 0; k < count; ++k) {
        double gamma = 0;
        for (int i = 0; i < concentration; ++i) gamma -= std::log(1 - random.uniform());
        shares.push_back(asFloat(gamma));
    }
    return shares;
}

Coat randomCoat(Random& random) {
    Coat coat;
    coat.strength = asFloat(random.uniform(0.3, 1));
    coat.roughness = asFloat(random.logUniform(kLeastRoughness, 0.25));
    coat.reflectance = asFloat(random.uniform(0.02, 0.08));
    coat.refraction = asFloat(random.uniform(1, 1.6));
    return coat;
}

std::vector<Facet> tiltedFacets(float groove, Random& random) {
    const std::size_t count = 2 + random.below(5);
    const bool same = random.chance(0.5);
    const Facet first = randomFacet(randomFacetKind(random), random);
    const std::vector<float> shares = randomShares(count, 1, random);
    const double mostTilt = random.uniform(0.05, 1.1);
    std::vector<Facet> facets;
    for (std::size_t k = 0; k < count; ++k) {
        Facet facet = same ? first : randomFacet(randomFacetKind(random), random);
        facet.tilt = random.uniform(0, mostTilt);
        facet.azimuth = random.uniform(0, 2 * kPi);
        facet.weight = shares[k];
        facet.groove = groove;
        facets.push_back(facet);
    }
    return facets;
}

/// The pieces of one thread along `azimuth`: to, fro and perhaps flat.
void addThread(Radians azimuth, float groove, Random& random, std::vector<Facet>& facets) {
    const double which = random.uniform();
    Facet piece = randomFacet(which < 0.4   ? FacetKind::kLobe
                              : which < 0.8 ? FacetKind::kFibre
                                            : FacetKind::kTwoLobes,
                              random);
    piece.fibre.azimuth = azimuth + 0.05 * random.normal();
    for (Lobe& lobe : piece.lobes) {
        if (lobe.strength == 0) continue;
        const double alpha = random.logUniform(0.06, 0.6);
        const double stretch = std::exp(0.5 * random.uniform(0, 1.6));
        lobe.roughnessX = asFloat(std::clamp(alpha / stretch, 0.04, kMostRoughness));
        lobe.roughnessY = asFloat(std::clamp(alpha * stretch, 0.04, kMostRoughness));
        lobe.azimuth = azimuth;
    }
    piece.weight = asFloat(random.uniform(0.1, 1));
    piece.groove = groove;
    const double tilt = random.uniform(0, 0.8);
    const std::size_t count = 2 + random.below(2);
    for (std::size_t k = 0; k < count; ++k) {
        piece.tilt = k == 2 ? 0 : tilt * random.uniform(0.8, 1.2);
        piece.azimuth = azimuth + (k == 1 ? kPi : 0);
        facets.push_back(piece);
    }
}

std::vector<Facet> ribbedFacets(float groove, Random& random) {
    Facet rib = randomFacet(randomFacetKind(random), random);
    const std::size_t count = 2 + random.below(4);
    const std::vector<float> shares = randomShares(count, 2, random);
    const double tilt = random.uniform(0.1, 1.1);
    std::vector<Facet> facets;
    for (std::size_t k = 0; k < count; ++k) {
        rib.tilt = k == 4 ? 0 : tilt * random.uniform(0.3, 1);
        rib.azimuth = k % 2 == 1 ? kPi : 0;
        rib.weight = shares[k];
        rib.groove = groove;
        facets.push_back(rib);
    }
    return facets;
}

/// exp(sum of 16 cosine waves of light, view and light . view): a smooth field of deviation
/// `amplitude`. Of an isotropic material it varies with theta_i, theta_v and light . view alone.
std::vector<CosineWave> randomField(bool isIsotropic, Random& random) {
    constexpr int kWaves = 16;
    const double amplitude = random.logUniform(0.03, 0.15);
    const double length = random.uniform(0.4, 1.5);
    std::vector<CosineWave> field;
    for (int k = 0; k < kWaves; ++k) {
        CosineWave wave;
        for (Imath::V3f* vector : {&wave.light, &wave.view}) {
            for (int axis = 0; axis < 3; ++axis) {
                (*vector)[axis] = asFloat(random.normal() / length);
            }
            if (isIsotropic) vector->x = vector->y = 0;
        }
        wave.between = asFloat(random.normal() / length);
        if (!isIsotropic && k < kWaves / 2) wave.between = 0;
        wave.phase = asFloat(random.uniform(0, 2 * kPi));
        wave.amplitude = asFloat(amplitude * std::sqrt(2.0 / kWaves) * std::abs(random.normal()));
        field.push_back(wave);
    }
    return field;
}

}  // namespace

AnalyticMaterial randomMaterial(MaterialClass materialClass, Random& random) {
    AnalyticMaterial material;
    material.azimuth = random.uniform(0, 2 * kPi);
    const float groove = random.chance(0.6) ? asFloat(random.uniform()) : 0;
    const bool isIsotropic = materialClass == MaterialClass::kIso;
    switch (materialClass) {
        case MaterialClass::kIso:
        case MaterialClass::kAniso: {
            const Facet facet = randomFacet(randomFacetKind(random), random);
            material.facets = {isIsotropic ? isotropic(facet) : facet};
            if (random.chance(isIsotropic ? 0.5 : 0.35)) material.coat = randomCoat(random);
            break;
        }
        case MaterialClass::kTilt:
            material.facets = tiltedFacets(groove, random);
            break;
        case MaterialClass::kWoven:
            addThread(0, groove, random, material.facets);
            addThread(kPi / 2, groove, random, material.facets);
            break;
        case MaterialClass::kRibs:
            material.facets = ribbedFacets(groove, random);
            break;
    }
    if (random.chance(0.5)) material.field = randomField(isIsotropic, random);
    return material;
}

std::vector<AnalyticMaterial> randomMaterials(MaterialClass materialClass, std::size_t count,
                                              std::uint64_t seed) {
    std::vector<AnalyticMaterial> materials;
    materials.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        // A stream a material, so that one more never changes those before.
        Random random(seed, hashOf({static_cast<std::uint64_t>(materialClass), i}));
        materials.push_back(randomMaterial(materialClass, random));
    }
    return materials;
}

}  // namespace abrdf
