// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/microfacet.h"

#include "abrdf/analytic_material.h"
#include "abrdf/direction.h"
#include "abrdf/random.h"
#include "tests/support/facets.h"

#include <doctest/doctest.h>

#include <cmath>

namespace abrdf {

namespace {

using Imath::V3f;

/// The share of the light from `light` that leaves again: the integral of value(light, w) cos_w /
/// (pi cos_light) over all views w.
double albedo(const AnalyticMaterial& material, const V3f& light) {
    const PreparedMaterial prepared(material);
    constexpr int kThetas = 400;
    constexpr int kPhis = 256;
    double sum = 0;
    for (int t = 0; t < kThetas; ++t) {
        const double theta = (t + 0.5) / kThetas * kPi / 2;
        for (int p = 0; p < kPhis; ++p) {
            const V3f view(vectorFromDirection({theta, (p + 0.5) / kPhis * 2 * kPi}));
            sum += static_cast<double>(prepared.evaluate(light, view)) * std::cos(theta) *
                   std::sin(theta);
        }
    }
    const double cell = (kPi / 2 / kThetas) * (2 * kPi / kPhis);
    return sum * cell / (kPi * static_cast<double>(light.z));
}

/// GGX with Smith's height-correlated masking, in doubles and angles, after [Heitz 2014].
double ggxTwin(const V3f& light, const V3f& view, double ax, double ay, double f0) {
    const Imath::V3d l(light);
    const Imath::V3d v(view);
    const Imath::V3d h = (l + v).normalized();
    const double theta = std::acos(h.z);
    const double phi = std::atan2(h.y, h.x);
    const double tan2 = std::tan(theta) * std::tan(theta);
    const double e = tan2 * (std::pow(std::cos(phi) / ax, 2) + std::pow(std::sin(phi) / ay, 2));
    const double d = 1 / (kPi * ax * ay * std::pow(std::cos(theta), 4) * (1 + e) * (1 + e));
    const auto lambda = [&](const Imath::V3d& w) {
        const double azimuth = std::atan2(w.y, w.x);
        const double alpha2 =
            std::pow(std::cos(azimuth) * ax, 2) + std::pow(std::sin(azimuth) * ay, 2);
        const double tangent = std::tan(std::acos(w.z));
        return (std::sqrt(1 + alpha2 * tangent * tangent) - 1) / 2;
    };
    const double f = f0 + (1 - f0) * std::pow(1 - l.dot(h), 5);
    return kPi * d * f / (1 + lambda(l) + lambda(v)) / (4 * v.z);
}

}  // namespace

TEST_SUITE("unit") {
    TEST_CASE("a GGX lobe is its closed form") {
        Random random(1);
        for (int i = 0; i < 500; ++i) {
            const double ax = random.logUniform(0.05, 0.9);
            const double ay = random.logUniform(0.05, 0.9);
            Facet facet = mirror(LobeShape::kGgx, static_cast<float>(ax), static_cast<float>(ay));
            facet.lobes[0].fresnel = {0.04F, 1, 5};
            const V3f light = unit(random.uniform(0, 85), random.uniform(0, 360));
            const V3f view = unit(random.uniform(0, 85), random.uniform(0, 360));
            CHECK(evaluate(flat(facet), light, view) ==
                  doctest::Approx(ggxTwin(light, view, ax, ay, 0.04)).epsilon(2e-4));
        }
    }

    TEST_CASE("a long tail with exponent 2 is GGX") {
        const AnalyticMaterial ggx = flat(mirror(LobeShape::kGgx, 0.2F, 0.4F));
        const AnalyticMaterial tail = flat(mirror(LobeShape::kLongTail, 0.2F, 0.4F));
        CHECK(evaluate(tail, unit(40, 20), unit(30, 170)) ==
              doctest::Approx(evaluate(ggx, unit(40, 20), unit(30, 170))).epsilon(1e-5));
    }

    TEST_CASE("no more light leaves than arrives") {
        for (const double theta : {0.0, 45.0, 75.0}) {
            CAPTURE(theta);
            const V3f light = unit(theta, 30);
            CHECK(albedo(flat(lambertian(1)), light) == doctest::Approx(1).epsilon(1e-3));
            for (const float roughness : {0.1F, 0.4F, 0.9F}) {
                CAPTURE(roughness);
                const float across = 0.8F * roughness;
                CHECK(albedo(flat(mirror(LobeShape::kGgx, roughness, across)), light) < 1.001);
                CHECK(albedo(flat(mirror(LobeShape::kBeckmann, roughness, across)), light) < 1.001);
            }
        }
        // A smooth mirror without absorption loses next to nothing to its own masking.
        CHECK(albedo(flat(mirror(LobeShape::kGgx, 0.1F, 0.1F)), unit(30, 0)) > 0.98);
        AnalyticMaterial varnished = flat(lambertian(1));
        varnished.coat = {1, 0.05F, 0.04F, 1.5F};
        CHECK(albedo(varnished, unit(40, 0)) < 1);
    }
}

}  // namespace abrdf
