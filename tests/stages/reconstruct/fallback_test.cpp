// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/random.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/neighbour_error.h"
#include "stages/reconstruct/reconstructor.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("the estimate of a material that contradicts every model is a bound of its error") {
    Random random(3);
    const SmallPrior& prior = smallPrior();
    int fallbacks = 0;
    int obeyed = 0;
    double worst = 0;
    double shares = 0;
    for (int i = 0; i < 400; ++i) {
        CAPTURE(i);
        const bool isStep = i % 2 == 0;
        const double turn = random.uniform(0, 2 * kPi);
        const double dark = random.uniform(0.02, 0.3);
        const auto truth = [&](const LightAndView& pair) {
            const double side = isStep && std::sin(pair.view.phi + turn) > 0 ? dark : 0.8;
            const auto value = static_cast<float>(side * std::cos(pair.light.theta));
            return Rgb{value, value, value};
        };
        std::vector<Rgb> samples = prior.samplesOf(truth);
        for (Rgb& c : samples) {
            if (!isStep && random.chance(0.05)) c = random.chance(0.5) ? Rgb{} : 100.0F * c;
        }
        const auto reconstructor = methodFromName("prior").make(
            {{}, prior.samples, prior.grid, prior.grid, samples, {}, prior.model, {}});
        if (reconstructor->remark().empty()) continue;
        ++fallbacks;
        std::vector<Rgb> abrdf(prior.grid.pairCount());
        std::vector<float> estimate(1);
        reconstructor->reconstructKnowing(samples, abrdf, estimate);
        const double error = measureAccuracy(prior.abrdfOf(truth), abrdf, {}, {}).natural.deltaE;
        worst = std::max(worst, error / static_cast<double>(estimate[0]));
        obeyed += error <= static_cast<double>(estimate[0]) ? 1 : 0;
        shares += error / static_cast<double>(estimate[0]);
    }
    CHECK(fallbacks > 200);
    CHECK(obeyed == fallbacks);
    CHECK(shares > 0.35 * fallbacks);  // No bound is worth more than it is tight.
    MESSAGE(fallbacks, " fallbacks, error ", shares / fallbacks, " of the bound, up to ", worst);
}

TEST_SUITE_END();
