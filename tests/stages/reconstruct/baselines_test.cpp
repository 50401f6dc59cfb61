// SPDX-License-Identifier: BSD-3-Clause
//
// constant, nearest, idw, rbf and microfacet: what others do with the same samples.
#include "abrdf/pair_features.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/microfacet_fit.h"
#include "stages/reconstruct/reconstructor.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace abrdf;

namespace {

const std::vector<const char*> kBaselines = {"constant", "nearest", "idw", "rbf", "microfacet"};

/// Every eleventh pair of a small grid; no prior.
std::vector<Rgb> reconstructed(const std::string& method, const std::vector<Rgb>& samples) {
    const SmallPrior& prior = smallPrior();
    const auto reconstructor =
        methodFromName(method).make({{}, prior.samples, prior.grid, prior.grid, {}, {}, {}});
    std::vector<Rgb> abrdf(prior.grid.pairCount());
    reconstructor->reconstruct(samples, abrdf);
    return abrdf;
}

Rgb lambert(const LightAndView& pair) {
    const auto c = static_cast<float>(std::cos(pair.light.theta));
    return {0.8F * c, 0.3F * c, 0.1F * c};
}

double deltaEOf(const std::vector<Rgb>& truth, const std::vector<Rgb>& abrdf) {
    return measureAccuracy(truth, abrdf, {}, {}).natural.deltaE;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a Lambertian comes back from every baseline") {
    const std::vector<Rgb> truth = smallPrior().abrdfOf(lambert);
    for (const char* method : kBaselines) {
        CAPTURE(method);
        const std::vector<Rgb> abrdf = reconstructed(method, smallPrior().samplesOf(lambert));
        const std::vector<float> errors = deltaEMap(truth, abrdf, 1);
        CHECK(*std::ranges::max_element(errors) < 0.1F);
    }
}

TEST_CASE("black stays black") {
    const std::vector<Rgb> black(smallPrior().samples.count());
    for (const char* method : kBaselines) {
        CAPTURE(method);
        const auto abrdf = reconstructed(method, black);
        CHECK(std::ranges::all_of(abrdf, [](const Rgb& c) { return c == Rgb{}; }));
    }
}

TEST_CASE("the unit of the samples is the unit of a baseline's answer") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    for (const char* method : kBaselines) {
        CAPTURE(method);
        const std::vector<Rgb> once = reconstructed(method, samples);
        for (const float unit : {1e-3F, 1e3F}) {
            std::vector<Rgb> scaled = samples;
            for (Rgb& c : scaled) c *= unit;
            const std::vector<Rgb> abrdf = reconstructed(method, scaled);
            for (std::size_t i = 0; i < once.size(); ++i) {
                CHECK(abrdf[i].r / unit == doctest::Approx(once[i].r).epsilon(2e-3).scale(0.01));
            }
        }
    }
}

TEST_CASE("samples are reproduced by those that interpolate") {
    const std::vector<Rgb> truth = smallPrior().abrdfOf(plastic);
    for (const char* method : {"nearest", "idw", "rbf"}) {
        CAPTURE(method);
        const std::vector<Rgb> abrdf = reconstructed(method, smallPrior().samplesOf(plastic));
        for (const std::size_t pair : smallPrior().samples.pairs) {
            CHECK(abrdf[pair].g == doctest::Approx(truth[pair].g).epsilon(1e-3));
        }
    }
}

TEST_CASE("idw is its equation, from the four nearest samples") {
    const SmallPrior& prior = smallPrior();
    const std::vector<Rgb> samples = prior.samplesOf(plastic);
    const std::vector<Rgb> abrdf = reconstructed("idw", samples);
    const auto& directions = prior.samples.directions;
    for (std::size_t pair = 0; pair < abrdf.size(); pair += 17) {
        const LightAndView target = prior.grid.pair(pair);
        std::vector<std::pair<double, std::size_t>> byDistance;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            byDistance.emplace_back(squaredDistance(directions[k], target), k);
        }
        std::ranges::sort(byDistance);
        if (byDistance[0].first < 1e-9) continue;  // A sample itself.
        double sum = 0;
        double weights = 0;
        for (const auto& [distance, k] : byDistance) {
            if (distance > byDistance[3].first + 1e-9) break;  // Equals count as one another do.
            const double cosine = std::cos(directions[k].light.theta);
            sum += static_cast<double>(samples[k].g) / cosine / distance;
            weights += 1 / distance;
        }
        CHECK(abrdf[pair].g ==
              doctest::Approx(sum / weights * std::cos(target.light.theta)).epsilon(1e-4));
    }
}

TEST_CASE("a microfacet material's own numbers are found again") {
    MicrofacetFit made;
    made.diffuse = {0.3F, 0.15F, 0.05F};
    made.specular = {0.04F, 0.04F, 0.04F};
    made.roughnessX = 0.15;
    made.roughnessY = 0.45;
    made.azimuth = 0.6;
    made.grazing = 8;
    const PreparedLobe lobe(made.lobe());
    const auto material = [&](const LightAndView& pair) {
        const LocalPair local(Imath::V3f(vectorFromDirection(pair.light)),
                              Imath::V3f(vectorFromDirection(pair.view)));
        return static_cast<float>(std::cos(pair.light.theta)) *
               (made.diffuse + lobe.reflectanceFactor(local) * made.specular);
    };
    const std::vector<Rgb> samples = smallPrior().samplesOf(material);
    const MicrofacetFit fit = fitMicrofacet(smallPrior().samples.directions, samples);
    CHECK(fit.diffuse.r == doctest::Approx(made.diffuse.r).epsilon(0.02));
    CHECK(fit.specular.g == doctest::Approx(made.specular.g).epsilon(0.05));
    const std::vector<Rgb> abrdf = reconstructed("microfacet", samples);
    CHECK(deltaEOf(smallPrior().abrdfOf(material), abrdf) < 0.2);
}

TEST_CASE("each baseline's error on a plastic is in its place") {
    const std::vector<Rgb> truth = smallPrior().abrdfOf(plastic);
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const auto error = [&](const char* method) {
        return deltaEOf(truth, reconstructed(method, samples));
    };
    // A sharp highlight is no friend of distances: which of these is better depends on the samples.
    for (const char* method : {"nearest", "idw", "rbf"}) {
        CAPTURE(method);
        CHECK(error("microfacet") < error(method));
        CHECK(error(method) < error("constant"));
    }
}

TEST_SUITE_END();
