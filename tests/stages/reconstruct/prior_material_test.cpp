// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_material.h"

#include "abrdf/random.h"
#include "stages/measure/measures.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

using namespace abrdf;

namespace {

std::vector<Rgb> estimated(const std::vector<Rgb>& samples,
                           const ReconstructOptions& options = {}) {
    std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
    PriorMaterial(*smallPrior().model, smallPrior().rowOf(), samples, options)
        .reconstruct(samples, abrdf);
    return abrdf;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a Lambertian comes back, whatever its colour and unit") {
    for (const double unit : {1.0, 1e-3, 400.0}) {
        const auto lambert = [&](const LightAndView& pair) {
            const auto c = static_cast<float>(unit * std::cos(pair.light.theta));
            return Rgb{0.8F * c, 0.4F * c, 0.1F * c};
        };
        const std::vector<Rgb> truth = smallPrior().abrdfOf(lambert);
        const std::vector<Rgb> abrdf = estimated(smallPrior().samplesOf(lambert));
        for (std::size_t i = 0; i < truth.size(); ++i) {
            CHECK(abrdf[i].r == doctest::Approx(truth[i].r).epsilon(0.002));
            CHECK(abrdf[i].b == doctest::Approx(truth[i].b).epsilon(0.002));
        }
    }
}

TEST_CASE("the samples themselves are reproduced, and the rest is near the truth") {
    const std::vector<Rgb> truth = smallPrior().abrdfOf(plastic);
    const std::vector<Rgb> abrdf = estimated(smallPrior().samplesOf(plastic));
    CHECK(measureAccuracy(truth, abrdf, {}, {}).natural.deltaE < 2.5);
    double worst = 0;
    for (const auto& sources : smallPrior().samples.sources) {
        const std::size_t pair = sources[0].pair;
        worst = std::max(worst, static_cast<double>(std::abs(abrdf[pair].g / truth[pair].g - 1)));
    }
    CHECK(worst < 0.05);
}

TEST_CASE("black is black, and a channel of zeros stays zero") {
    for (const Rgb& value : estimated(smallPrior().samplesOf([](auto&) { return Rgb{}; }))) {
        CHECK(value == Rgb{});
    }
    const auto noGreen = [](const LightAndView& pair) {
        const Rgb c = plastic(pair);
        return Rgb{c.r, 0, c.b};
    };
    for (const Rgb& value : estimated(smallPrior().samplesOf(noGreen))) {
        CHECK(value.g == 0);
        CHECK(value.r > 0);
    }
}

TEST_CASE("the unit of the samples is the unit of the answer") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const std::vector<Rgb> once = estimated(samples);
    for (const float unit : {1e-4F, 1e4F}) {
        std::vector<Rgb> scaled = samples;
        for (Rgb& c : scaled) c *= unit;
        const std::vector<Rgb> abrdf = estimated(scaled);
        for (std::size_t i = 0; i < once.size(); ++i) {
            CHECK(abrdf[i].r / unit == doctest::Approx(once[i].r).epsilon(1e-4));
        }
    }
}

TEST_CASE("no numbers make a negative, infinite or undefined answer") {
    Random random(5);
    for (int round = 0; round < 40; ++round) {
        std::vector<Rgb> samples;
        for (std::size_t k = 0; k < smallPrior().samples.count(); ++k) {
            const auto any = [&] {
                return random.chance(0.2)
                           ? 0.0F
                           : static_cast<float>(std::exp(random.uniform(-60.0, 40.0)));
            };
            samples.push_back({any(), any(), any()});
        }
        for (const Rgb& value : estimated(samples)) {
            CHECK(isFinite(value));
            CHECK_FALSE(isNegative(value));
        }
    }
}

TEST_CASE("a low rank is exact for the material's mean, and costs less") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const std::vector<Rgb> full = estimated(samples);
    const std::vector<Rgb> few = estimated(samples, {.rank = 4});
    for (std::size_t i = 0; i < full.size(); ++i) {
        CHECK(few[i].g == doctest::Approx(full[i].g).epsilon(1e-3));
    }
    const PriorModel& model = *smallPrior().model;
    CHECK(PriorMaterial(model, smallPrior().rowOf(), samples, {.rank = 4}).multiplyAdds() <
          0.5 * PriorMaterial(model, smallPrior().rowOf(), samples, {}).multiplyAdds());
}

TEST_CASE("a texel that is alone needs no maps for its ABRDF and its estimate") {
    const auto brushed = [](const LightAndView& pair) {
        const double turn = pair.light.phi + pair.view.phi;
        return (1.5F + static_cast<float>(std::cos(turn))) * plastic(pair);
    };
    const auto black = [](const LightAndView&) { return Rgb{}; };
    const auto red = [](const LightAndView& pair) { return Rgb{plastic(pair).r, 0, 0}; };
    const PriorModel& model = *smallPrior().model;
    for (const std::function<Rgb(const LightAndView&)>& material :
         {std::function<Rgb(const LightAndView&)>(plastic),
          std::function<Rgb(const LightAndView&)>(brushed),
          std::function<Rgb(const LightAndView&)>(black),
          std::function<Rgb(const LightAndView&)>(red)}) {
        for (const double saturated : {0.0, 0.3}) {
            const std::vector<Rgb> samples = smallPrior().samplesOf(material);
            const PriorMaterial whole(model, smallPrior().rowOf(), samples,
                                      {.saturated = saturated});
            const PriorMaterial alone(model, smallPrior().rowOf(), samples,
                                      {.saturated = saturated, .alone = true});
            CHECK(alone.model().columns() == 1);
            std::vector<Rgb> wanted(smallPrior().grid.pairCount());
            std::vector<Rgb> found(wanted.size());
            float wantedError = 0;
            float foundError = 0;
            whole.model().evaluate(whole.encode(samples, {&wantedError, 1}), wanted);
            alone.model().evaluate(alone.encode(samples, {&foundError, 1}), found);
            CHECK(foundError == doctest::Approx(wantedError).epsilon(1e-4));
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                CHECK(found[i].r == doctest::Approx(wanted[i].r).epsilon(2e-6));
                CHECK(found[i].g == doctest::Approx(wanted[i].g).epsilon(2e-6));
                CHECK(found[i].b == doctest::Approx(wanted[i].b).epsilon(2e-6));
            }
        }
    }
    const PriorMaterial alone(model, smallPrior().rowOf(), smallPrior().samplesOf(plastic),
                              {.alone = true});
    CHECK_THROWS_AS(alone.encode(smallPrior().samplesOf(brushed)), std::logic_error);
}

TEST_SUITE_END();
