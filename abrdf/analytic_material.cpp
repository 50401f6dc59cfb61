// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/analytic_material.h"

#include "abrdf/portable_math.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace abrdf {

using Imath::V3f;

namespace {

Lobe lobeOf(const Coat& coat) {
    Lobe lobe;
    lobe.strength = coat.strength;
    lobe.fresnel.normal = coat.reflectance;
    lobe.roughnessX = lobe.roughnessY = coat.roughness;
    return lobe;
}

/// `vector` after a turn about the normal.
V3f turned(const V3f& vector, Radians angle) {
    const auto c = static_cast<float>(std::cos(angle));
    const auto s = static_cast<float>(std::sin(angle));
    return {c * vector.x - s * vector.y, s * vector.x + c * vector.y, vector.z};
}

/// [Schlick 1994].
float transmitted(float reflectance, float cosine) {
    const float t = 1 - cosine;
    const float t2 = t * t;
    return (1 - reflectance) * (1 - t2 * t2 * t);
}

/// Snell: inside a layer of this index.
V3f refracted(const V3f& direction, float index) {
    const float ratio = 1 / index;
    // 1 - ratio^2 sin^2, in a form that does not vanish before its time.
    const float z2 = (1 - ratio * ratio) + ratio * ratio * direction.z * direction.z;
    return {direction.x * ratio, direction.y * ratio, std::sqrt(z2)};
}

/// The part of a V-groove's wall that `direction` reaches [Torrance, Sparrow 1967]: 2 (n.h)(n.w) /
/// (w.h) with the wall's normal for h.
float reached(float cosTilt, const V3f& direction, float cosToWall) {
    return std::min(1.0F, 2 * cosTilt * direction.z / std::max(cosToWall, 1e-6F));
}

}  // namespace

PreparedMaterial::TiltedFacet::TiltedFacet(const Facet& facet)
    : scattering(facet), weight(facet.weight), groove(facet.groove) {
    // The turn that takes the surface's normal to the facet's along the shortest way.
    const auto c = static_cast<float>(std::cos(facet.azimuth));
    const auto s = static_cast<float>(std::sin(facet.azimuth));
    const auto cosTilt = static_cast<float>(std::cos(facet.tilt));
    const auto sinTilt = static_cast<float>(std::sin(facet.tilt));
    x = {1 - c * c * (1 - cosTilt), -c * s * (1 - cosTilt), -c * sinTilt};
    y = {-c * s * (1 - cosTilt), 1 - s * s * (1 - cosTilt), -s * sinTilt};
    normal = {c * sinTilt, s * sinTilt, cosTilt};
}

PreparedMaterial::PreparedMaterial(const AnalyticMaterial& material)
    : coat_(material.coat), coatLobe_(lobeOf(material.coat)), scale_(material.scale) {
    for (const Facet& facet : material.facets) {
        facets_.emplace_back(turned(facet, material.azimuth));
    }
    for (const CosineWave& wave : material.field) {
        const V3f light = turned(wave.light, material.azimuth);
        const V3f view = turned(wave.view, material.azimuth);
        for (int axis = 0; axis < 3; ++axis) {
            field_.light[static_cast<std::size_t>(axis)].push_back(light[axis]);
            field_.view[static_cast<std::size_t>(axis)].push_back(view[axis]);
        }
        field_.between.push_back(wave.between);
        field_.phase.push_back(wave.phase);
        field_.amplitude.push_back(wave.amplitude);
    }
}

float PreparedMaterial::evaluate(const V3f& light, const V3f& view) const {
    if (light.z <= 0 || view.z <= 0) return 0;
    const float value = coat_.strength > 0 ? coated(light, view) : uncoated(light, view);
    return field_.phase.empty() ? value * scale_ : value * scale_ * fieldFactor(light, view);
}

void PreparedMaterial::evaluate(std::span<const VectorPair> pairs, std::span<float> values) const {
    assert(pairs.size() == values.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        values[k] = evaluate(pairs[k].light, pairs[k].view);
    }
}

// Mean over the facets, weighted with the area that is seen of each.
float PreparedMaterial::uncoated(const V3f& light, const V3f& view) const {
    float sum = 0;
    float seenArea = 0;
    for (const TiltedFacet& facet : facets_) {
        const float cosView = facet.normal.dot(view);
        if (cosView <= 0) continue;
        const float cosLight = facet.normal.dot(light);
        const float area = facet.weight * cosView;
        float seen = 1;
        float seenAndLit = 1;
        if (facet.groove > 0) {
            // Both fall on a wall from its open edge: the smaller part is lit and seen.
            seen = reached(facet.normal.z, view, cosView);
            seenAndLit = std::min(seen, reached(facet.normal.z, light, cosLight));
            seen = 1 + (seen - 1) * facet.groove;
            seenAndLit = 1 + (seenAndLit - 1) * facet.groove;
        }
        seenArea += area * seen;
        if (cosLight <= 0) continue;
        const V3f localLight(facet.x.dot(light), facet.y.dot(light), cosLight);
        const V3f localView(facet.x.dot(view), facet.y.dot(view), cosView);
        sum += area * seenAndLit * facet.scattering.evaluate(localLight, localView);
    }
    return seenArea > 0 ? sum / seenArea : 0;
}

float PreparedMaterial::coated(const V3f& light, const V3f& view) const {
    const V3f lightBelow = refracted(light, coat_.refraction);
    const V3f viewBelow = refracted(view, coat_.refraction);
    // The base's cosine is the one below; what lights it was spread by the refraction.
    const float below =
        uncoated(lightBelow, viewBelow) * (light.z / std::max(lightBelow.z, 1e-12F)) *
        transmitted(coat_.reflectance, light.z) * transmitted(coat_.reflectance, view.z);
    const LocalPair pair(light, view);
    return below + coatLobe_.reflectanceFactor(pair) * pair.cosLight;
}

float PreparedMaterial::fieldFactor(const V3f& light, const V3f& view) const {
    const float between = light.dot(view);
    constexpr std::size_t kWaves = 16;
    std::array<float, kWaves> terms;
    float exponent = 0;
    const std::size_t count = field_.phase.size();
    for (std::size_t first = 0; first < count; first += kWaves) {
        const std::size_t size = std::min(kWaves, count - first);
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t w = first + i;
            const float alongLight = field_.light[0][w] * light.x + field_.light[1][w] * light.y +
                                     field_.light[2][w] * light.z;
            const float alongView = field_.view[0][w] * view.x + field_.view[1][w] * view.y +
                                    field_.view[2][w] * view.z;
            const float argument =
                alongLight + alongView + field_.between[w] * between + field_.phase[w];
            terms[i] = field_.amplitude[w] * portable::cos(argument);
        }
        for (std::size_t i = 0; i < size; ++i) exponent += terms[i];
    }
    return portable::exp(exponent);
}

float evaluate(const AnalyticMaterial& material, const V3f& light, const V3f& view) {
    return PreparedMaterial(material).evaluate(light, view);
}

}  // namespace abrdf
