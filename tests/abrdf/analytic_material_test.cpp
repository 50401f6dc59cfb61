// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/analytic_material.h"

#include "abrdf/direction.h"
#include "abrdf/random.h"
#include "tests/support/facets.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace abrdf {

namespace {

using Imath::V3f;

/// A facet with everything on it.
Facet richFacet(Random& random) {
    Facet facet = lambertian(0.3F);
    facet.diffuse.orenNayarSigma = 0.4F;
    facet.diffuse.minnaertExponent = static_cast<float>(random.uniform(-0.4, 0.5));
    facet.diffuse.lommelSeeligerShare = 0.5F;
    facet.lobes[0] = mirror(LobeShape::kGgx, 0.006F, 0.3F).lobes[0];
    facet.lobes[1] = mirror(LobeShape::kLongTail, 0.2F, 0.1F).lobes[0];
    facet.lobes[1].tail = 1.4F;
    facet.lobes[1].fresnel = {0.1F, 0.6F, 3};
    facet.lobes[1].azimuth = random.uniform(0, kPi);
    facet.velvet = {0.2F, 0.3F};
    facet.fibre.strength = 0.5F;
    facet.fibre.azimuth = random.uniform(0, kPi);
    facet.fibre.azimuthShare = facet.fibre.grazingShare = 0.5F;
    facet.retro = {0.3F, 0.1F};
    return facet;
}

/// |f(l, v) - f(v, l)| relative to their sum, f the value without its cosine.
double asymmetry(const AnalyticMaterial& material, const V3f& light, const V3f& view) {
    const float there = evaluate(material, light, view) / light.z;
    const float back = evaluate(material, view, light) / view.z;
    return static_cast<double>(std::fabs(there - back) / (there + back));
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("a white Lambertian lit from its normal is exactly 1, and falls with the cosine") {
        const AnalyticMaterial white = flat(lambertian(1));
        CHECK(evaluate(white, V3f(0, 0, 1), V3f(0, 0, 1)) == 1);
        CHECK(evaluate(white, V3f(0, 0, 1), unit(75, 200)) == 1);
        for (const double theta : {15.0, 45.0, 75.0}) {
            CHECK(evaluate(white, unit(theta, 10), unit(60, 300)) ==
                  doctest::Approx(std::cos(radiansFromDegrees(theta))));
        }
    }

    TEST_CASE("Oren-Nayar without slopes, Minnaert with exponent 0 and no dust are Lambert") {
        Facet facet = lambertian(0.5F);
        facet.diffuse.orenNayarSigma = 1e-6F;
        CHECK(evaluate(flat(facet), unit(50, 0), unit(50, 40)) ==
              doctest::Approx(evaluate(flat(lambertian(0.5F)), unit(50, 0), unit(50, 40))));
    }

    TEST_CASE("Oren-Nayar is brighter towards the light than away from it") {
        Facet facet = lambertian(1);
        facet.diffuse.orenNayarSigma = 0.5F;
        const AnalyticMaterial rough = flat(facet);
        CHECK(evaluate(rough, unit(60, 0), unit(60, 0)) >
              1.5F * evaluate(rough, unit(60, 0), unit(60, 180)));
    }

    TEST_CASE("grooves and tilts make no light") {
        for (const float groove : {0.0F, 1.0F}) {
            AnalyticMaterial ribs;
            ribs.facets.assign(2, lambertian(1));
            ribs.facets[0].tilt = ribs.facets[1].tilt = 0.7;
            ribs.facets[1].azimuth = kPi;
            ribs.facets[0].groove = ribs.facets[1].groove = groove;
            // From above, each wall shows its cosine; a groove hides nothing there.
            const float above = evaluate(ribs, V3f(0, 0, 1), V3f(0, 0, 1));
            CHECK(above == doctest::Approx(std::cos(0.7)).epsilon(1e-5));
        }
    }

    TEST_CASE("one flat facet is reciprocal") {
        Random random(2);
        for (int i = 0; i < 50; ++i) {
            Facet facet = richFacet(random);
            const V3f light = unit(random.uniform(0, 85), random.uniform(0, 360));
            const V3f view = unit(random.uniform(0, 85), random.uniform(0, 360));
            CHECK(asymmetry(flat(facet), light, view) < 1e-3);
        }
    }

    TEST_CASE("masked facets are not reciprocal") {
        AnalyticMaterial ribs;
        ribs.facets = {lambertian(0.8F), lambertian(0.1F)};
        ribs.facets[0].tilt = ribs.facets[1].tilt = 0.8;
        ribs.facets[1].azimuth = kPi;
        CHECK(asymmetry(ribs, unit(60, 0), unit(0, 0)) > 0.1);
    }

    TEST_CASE("a flat isotropic facet does not change when it is turned, a brushed one does") {
        Facet smooth = mirror(LobeShape::kGgx, 0.3F, 0.3F);
        smooth.diffuse = lambertian(0.3F).diffuse;
        smooth.velvet.strength = 0.2F;
        AnalyticMaterial isotropic = flat(smooth);
        AnalyticMaterial brushed = flat(mirror(LobeShape::kGgx, 0.1F, 0.5F));
        const float before = evaluate(isotropic, unit(50, 20), unit(40, 170));
        const float brushedBefore = evaluate(brushed, unit(50, 20), unit(40, 170));
        isotropic.azimuth = brushed.azimuth = radiansFromDegrees(70);
        CHECK(evaluate(isotropic, unit(50, 20), unit(40, 170)) == doctest::Approx(before));
        CHECK(evaluate(brushed, unit(50, 20), unit(40, 170)) != doctest::Approx(brushedBefore));
    }

    TEST_CASE("turning a material is turning light and view the other way") {
        Random random(3);
        AnalyticMaterial material;
        material.facets = {richFacet(random), richFacet(random)};
        material.facets[0].tilt = 0.3;
        material.facets[1].tilt = 0.5;
        material.facets[1].azimuth = 2;
        material.facets[1].groove = 0.6F;
        CosineWave wave;
        wave.light = {1, 0.5F, 0};
        wave.view = {0, 2, 1};
        wave.amplitude = 0.2F;
        material.field.push_back(wave);
        const float still = evaluate(material, unit(35, 100), unit(55, 250));
        material.azimuth = radiansFromDegrees(40);
        CHECK(evaluate(material, unit(35, 140), unit(55, 290)) ==
              doctest::Approx(still).epsilon(1e-3));
    }

    TEST_CASE("a facet that is turned away from the light is black") {
        AnalyticMaterial material = flat(lambertian(1));
        material.facets[0].tilt = radiansFromDegrees(60);
        CHECK(evaluate(material, unit(45, 180), unit(0, 0)) == 0);
        CHECK(evaluate(material, unit(45, 0), unit(0, 0)) > 0.9F);
        // Its own back is not seen, and nothing else is there.
        CHECK(evaluate(material, unit(0, 0), unit(45, 180)) == 0);
        CHECK(evaluate(flat(lambertian(1)), V3f(0, 0.6F, -0.8F), V3f(0, 0, 1)) == 0);
    }

    TEST_CASE("a coat shines, and darkens what lies below it") {
        AnalyticMaterial varnished = flat(lambertian(0.5F));
        varnished.coat = {1, 0.05F, 0.04F, 1.5F};
        const V3f light = unit(40, 0);
        CHECK(evaluate(varnished, light, unit(40, 180)) >
              2 * evaluate(flat(lambertian(0.5F)), light, unit(40, 180)));
        CHECK(evaluate(varnished, light, unit(20, 90)) <
              evaluate(flat(lambertian(0.5F)), light, unit(20, 90)));
    }

    TEST_CASE("retro-reflection comes back, a fibre's light leaves along its cone") {
        Facet retro;
        retro.retro = {1, 0.05F};
        CHECK(evaluate(flat(retro), unit(50, 30), unit(50, 30)) >
              100 * evaluate(flat(retro), unit(50, 30), unit(50, 120)));
        Facet fibre;  // along x: the cone of a light at 45 degrees towards +x leaves towards -x
        fibre.fibre.strength = 1;
        CHECK(evaluate(flat(fibre), unit(45, 0), unit(45, 180)) >
              10 * evaluate(flat(fibre), unit(45, 0), unit(45, 0)));
    }

    TEST_CASE("no direction gives a NaN, an infinity or a negative value") {
        Random random(4);
        AnalyticMaterial material;
        for (int k = 0; k < 4; ++k) {
            material.facets.push_back(richFacet(random));
            material.facets.back().tilt = random.uniform(0, 1.2);
            material.facets.back().azimuth = random.uniform(0, 2 * kPi);
            material.facets.back().groove = 1;
        }
        const std::array<V3f, 7> grazing = {unit(90, 0),      unit(90, 180), unit(89.9999, 180),
                                            V3f(1, 0, 1e-6F), V3f(1, 0, 0),  V3f(-1, 0, 1e-30F),
                                            V3f(0, 0, 1)};
        for (const float coat : {0.0F, 1.0F}) {
            material.coat.strength = coat;
            for (const V3f& light : grazing) {
                for (const V3f& view : grazing) {
                    const float value = evaluate(material, light, view);
                    CHECK(std::isfinite(value));
                    CHECK(value >= 0);
                }
            }
        }
    }

    TEST_CASE("many pairs at once are one after the other") {
        Random random(5);
        const AnalyticMaterial material = flat(richFacet(random));
        const std::array<VectorPair, 2> pairs = {VectorPair{unit(10, 0), unit(20, 0)},
                                                 VectorPair{unit(30, 90), unit(60, 10)}};
        std::array<float, 2> values{};
        PreparedMaterial(material).evaluate(pairs, values);
        CHECK(values[0] == evaluate(material, pairs[0].light, pairs[0].view));
        CHECK(values[1] == evaluate(material, pairs[1].light, pairs[1].view));
    }
}

}  // namespace abrdf
