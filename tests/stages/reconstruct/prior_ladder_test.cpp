// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_ladder.h"

#include "stages/reconstruct/leave_out.h"
#include "stages/reconstruct/prior_material.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("ranks and bounds are meant of the outputs that matter") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const PriorModel& model = *smallPrior().model;
    std::vector<double> weights(smallPrior().rowOf().size(), 0);
    weights[5] = 1;
    float bound = 0;
    const auto rankOf = [&](double tolerance, const std::vector<double>& of) {
        ReconstructOptions options{.centered = false, .tolerance = tolerance};
        options.weights = of;
        return PriorMaterial(model, smallPrior().rowOf(), samples, options)
            .encode(samples, {&bound, 1})
            .ranks[0];
    };
    CHECK(rankOf(8, weights) <= rankOf(8, {}));
    const std::vector<float> shares =
        outputShares(model.samples, pairsOf(smallPrior().grid), weights);
    CHECK(std::accumulate(shares.begin(), shares.end(), 0.0F) == doctest::Approx(1));
    CHECK(std::ranges::count(shares, 0.0F) == std::ssize(shares) - 1);
}

TEST_CASE("a tolerance takes smaller models the larger it is, and its bound grows with them") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const PriorModel& model = *smallPrior().model;
    std::uint16_t last = 0xffff;
    for (const double tolerance : {1e-3, 1.0, 8.0, 60.0}) {
        const PriorMaterial material(model, smallPrior().rowOf(), samples,
                                     {.centered = false, .tolerance = tolerance});
        float bound = 0;
        const TexelCodes codes = material.encode(samples, {&bound, 1});
        CHECK(codes.ranks[0] <= last);
        last = codes.ranks[0];
        const bool isWhole = codes.ranks[0] == material.ranks().back();
        CHECK((isWhole || bound <= static_cast<float>(tolerance)));
        CHECK(bound > 0);
    }
    CHECK(last == kConstantRank);
}

TEST_CASE("a whole texel of a ladder has the bits of a model without one") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const auto estimated = [&](const ReconstructOptions& options) {
        std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
        PriorMaterial(*smallPrior().model, smallPrior().rowOf(), samples, options)
            .reconstruct(samples, abrdf);
        return abrdf;
    };
    CHECK(estimated({}) == estimated({.tolerance = 1e-6}));
}

TEST_SUITE_END();
