// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_fit.h"

#include "stages/measure/measures.h"
#include "stages/reconstruct/prior_material.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("models are chosen by texels where there are some, else by the mean") {
    // A texel that is half plastic, half its shadow side: unlike the mean, whose models it ignores.
    const auto texel = [](const LightAndView& pair) {
        const double facing = std::cos(pair.light.phi) * std::sin(pair.light.theta);
        const auto lit = static_cast<float>(facing > 0.1 ? 1 : 0.05);
        return lit * plastic(pair);
    };
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> mean = smallPrior().samplesOf(plastic);
    const std::vector<Rgb> one = smallPrior().samplesOf(texel);
    std::vector<Rgb> two = one;
    two.insert(two.end(), one.begin(), one.end());
    const auto errorOfTexel = [&](const std::vector<Rgb>& texels) {
        std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
        PriorMaterial(model, smallPrior().rowOf(), mean, {}, texels).reconstruct(one, abrdf);
        return measureAccuracy(smallPrior().abrdfOf(texel), abrdf, {}, {}).natural.deltaE;
    };
    CHECK(errorOfTexel(one) < 0.9 * errorOfTexel({}));
    const PriorFit byMean = fitPrior(model, mean, {}, {});
    const PriorFit byTexel = fitPrior(model, mean, one, {});
    const PriorFit byTwo = fitPrior(model, mean, two, {});
    CHECK(byTexel.leaveOneOutError > byMean.leaveOneOutError);
    // A texel twice is that texel; the mean as the only texel is the mean.
    REQUIRE(byTwo.terms.size() == byTexel.terms.size());
    for (std::size_t i = 0; i < byTwo.terms.size(); ++i) {
        CHECK(byTwo.terms[i].classIndex == byTexel.terms[i].classIndex);
        CHECK(byTwo.terms[i].weight == doctest::Approx(byTexel.terms[i].weight));
    }
    CHECK(byTwo.leaveOneOutError == doctest::Approx(byTexel.leaveOneOutError));
    CHECK(fitPrior(model, mean, mean, {}).leaveOneOutError == byMean.leaveOneOutError);
}

TEST_SUITE_END();
