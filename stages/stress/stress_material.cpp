// SPDX-License-Identifier: BSD-3-Clause
#include "stages/stress/stress_material.h"

#include <memory>
#include <utility>

namespace abrdf {

namespace {

ColoredPart partOf(const Facet& facet, Rgb color) {
    ColoredPart part;
    part.material.facets = {facet};
    part.color = color;
    return part;
}

ColoredPart velvetPart() {
    Facet facet;
    facet.diffuse.albedo = 0.1F;
    facet.velvet.strength = 0.5F;
    facet.velvet.sigma = 0.4F;
    return partOf(facet, {0.6F, 0.1F, 0.2F});
}

/// Warp along x and weft along y, each to and fro, masking one another.
ColoredPart threads(Radians along, Rgb color) {
    ColoredPart part;
    part.color = color;
    for (const double side : {-1.0, 1.0}) {
        Facet facet;
        facet.tilt = radiansFromDegrees(18);
        facet.azimuth = along + (side > 0 ? 0 : kPi);
        facet.groove = 0.6F;
        facet.diffuse.albedo = 0.5F;
        facet.fibre.strength = 0.25F;
        facet.fibre.azimuth = along;
        facet.fibre.width = 0.25F;
        part.material.facets.push_back(facet);
    }
    return part;
}

}  // namespace

StressMaterial analyticStressMaterial(std::string name, const std::vector<ColoredPart>& parts) {
    auto prepared = std::make_shared<std::vector<std::pair<PreparedMaterial, Rgb>>>();
    for (const ColoredPart& part : parts) {
        prepared->emplace_back(PreparedMaterial(part.material), part.color);
    }
    return {std::move(name), [prepared](const LightAndView& pair) {
                const Imath::V3f light(vectorFromDirection(pair.light));
                const Imath::V3f view(vectorFromDirection(pair.view));
                Rgb sum;
                for (const auto& [material, color] : *prepared) {
                    sum += material.evaluate(light, view) * color;
                }
                return sum;
            }};
}

ColoredPart lambertPart(Rgb color) {
    Facet facet;
    facet.diffuse.albedo = 1;
    return partOf(facet, color);
}

ColoredPart highlightPart(float roughnessX, float roughnessY, float normal, Rgb color) {
    Facet facet;
    facet.lobes[0].strength = 1;
    facet.lobes[0].fresnel.normal = normal;
    facet.lobes[0].roughnessX = roughnessX;
    facet.lobes[0].roughnessY = roughnessY;
    return partOf(facet, color);
}

std::vector<StressMaterial> stressMaterials() {
    const Rgb white{1, 1, 1};
    return {
        analyticStressMaterial("matt", {lambertPart({0.5F, 0.3F, 0.15F})}),
        analyticStressMaterial("plastic", {lambertPart({0.1F, 0.25F, 0.4F}),
                                           highlightPart(0.25F, 0.25F, 0.04F, white)}),
        analyticStressMaterial(
            "satin", {lambertPart({0.25F, 0.1F, 0.1F}), highlightPart(0.15F, 0.45F, 0.08F, white)}),
        analyticStressMaterial("metal", {highlightPart(0.4F, 0.4F, 0.9F, {1, 0.75F, 0.35F})}),
        analyticStressMaterial("velvet", {velvetPart()}),
        analyticStressMaterial(
            "weave", {threads(0, {0.25F, 0.15F, 0.1F}), threads(kPi / 2, {0.1F, 0.2F, 0.3F})}),
    };
}

StressMaterial turned(const StressMaterial& material, Radians azimuth) {
    return {material.name, [value = material.value, azimuth](const LightAndView& pair) {
                return value({{pair.light.theta, wrappedAzimuth(pair.light.phi - azimuth)},
                              {pair.view.theta, wrappedAzimuth(pair.view.phi - azimuth)}});
            }};
}

}  // namespace abrdf
