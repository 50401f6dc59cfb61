// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/random_material.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

namespace {

Imath::V3f unitVector(double thetaDegrees, double phiDegrees) {
    return Imath::V3f(
        vectorFromDirection({radiansFromDegrees(thetaDegrees), radiansFromDegrees(phiDegrees)}));
}

/// Share of light from `light` that leaves over the hemisphere: integral of f cos(theta_v).
double reflected(const PreparedMaterial& material, double thetaLight) {
    constexpr int kThetas = 40;
    constexpr int kPhis = 60;
    const Imath::V3f light = unitVector(thetaLight, 20);
    double sum = 0;
    for (int i = 0; i < kThetas; ++i) {
        const double theta = (i + 0.5) * 90 / kThetas;
        for (int j = 0; j < kPhis; ++j) {
            const double value =
                static_cast<double>(material.evaluate(light, unitVector(theta, 360.0 * j / kPhis)));
            const double t = radiansFromDegrees(theta);
            // value = pi f cos(theta_i), so f = value / (pi cos(theta_i)).
            sum += value / (kPi * std::cos(radiansFromDegrees(thetaLight))) * std::cos(t) *
                   std::sin(t) * radiansFromDegrees(90.0 / kThetas) * 2 * kPi / kPhis;
        }
    }
    return sum;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a seed gives the same materials, and more of them do not change the first") {
    for (const MaterialClass materialClass : kMaterialClasses) {
        const auto few = randomMaterials(materialClass, 5, 1);
        const auto many = randomMaterials(materialClass, 9, 1);
        const auto other = randomMaterials(materialClass, 5, 2);
        const Imath::V3f light = unitVector(40, 10);
        const Imath::V3f view = unitVector(50, 200);
        int same = 0;
        for (std::size_t i = 0; i < few.size(); ++i) {
            CHECK(evaluate(few[i], light, view) == evaluate(many[i], light, view));
            same += evaluate(few[i], light, view) == evaluate(other[i], light, view) ? 1 : 0;
        }
        CHECK(same == 0);
    }
}

TEST_CASE("materials of class iso do not change when they are turned, those of others do") {
    for (const MaterialClass materialClass : kMaterialClasses) {
        int turned = 0;
        for (const AnalyticMaterial& material : randomMaterials(materialClass, 60, 3)) {
            const float once = evaluate(material, unitVector(50, 0), unitVector(40, 130));
            const float twice = evaluate(material, unitVector(50, 75), unitVector(40, 205));
            turned += std::abs(twice - once) > 1e-4F * std::abs(once) + 1e-7F ? 1 : 0;
        }
        CAPTURE(nameOf(materialClass));
        if (materialClass == MaterialClass::kIso) {
            CHECK(turned == 0);
        } else {
            CHECK(turned > 15);
        }
    }
}

TEST_CASE("masked threads are not reciprocal, plain isotropic facets are") {
    int reciprocal = 0;
    int plain = 0;
    for (const AnalyticMaterial& material : randomMaterials(MaterialClass::kIso, 80, 4)) {
        if (!material.field.empty() || material.coat.strength > 0) continue;
        ++plain;
        // The values hold the cosine of the light's angle.
        const float once =
            evaluate(material, unitVector(20, 0), unitVector(65, 120)) / std::cos(0.349066F);
        const float swapped =
            evaluate(material, unitVector(65, 120), unitVector(20, 0)) / std::cos(1.134464F);
        reciprocal += std::abs(once - swapped) < 1e-3F * once ? 1 : 0;
    }
    CHECK(plain > 10);
    CHECK(reciprocal == plain);
    int broken = 0;
    for (const AnalyticMaterial& material : randomMaterials(MaterialClass::kWoven, 40, 4)) {
        const float once =
            evaluate(material, unitVector(20, 0), unitVector(65, 120)) / std::cos(0.349066F);
        const float swapped =
            evaluate(material, unitVector(65, 120), unitVector(20, 0)) / std::cos(1.134464F);
        broken += std::abs(once - swapped) > 0.02F * once ? 1 : 0;
    }
    CHECK(broken > 20);
}

TEST_CASE("one body or one lobe alone reflects no more than it gets") {
    for (AnalyticMaterial material : randomMaterials(MaterialClass::kAniso, 60, 5)) {
        material.field.clear();
        material.coat = {};
        Facet& facet = material.facets[0];
        facet.velvet = {};
        facet.fibre = {};
        facet.retro = {};
        facet.diffuse.minnaertExponent = 0;
        facet.diffuse.lommelSeeligerShare = 0;
        facet.lobes[1].strength = 0;
        // A highlight narrower than the quadrature cannot be integrated by it.
        for (float* roughness : {&facet.lobes[0].roughnessX, &facet.lobes[0].roughnessY}) {
            *roughness = std::max(*roughness, 0.2F);
        }
        const Diffuse body = facet.diffuse;
        facet.diffuse = {};
        if (facet.lobes[0].shape != LobeShape::kLongTail) {
            CHECK(reflected(PreparedMaterial(material), 30) < 1.01);
        }
        facet.lobes[0].strength = 0;
        facet.diffuse = body;
        CHECK(reflected(PreparedMaterial(material), 30) < 1.01);
    }
}

TEST_SUITE_END();
