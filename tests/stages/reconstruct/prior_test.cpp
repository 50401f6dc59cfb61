// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "abrdf/register_bytes.h"
#include "stages/reconstruct/reconstructor.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

using namespace abrdf;

namespace {

ReconstructionTask taskFor(const std::vector<Rgb>& mean) {
    const SmallPrior& prior = smallPrior();
    return {{}, prior.samples, prior.grid, prior.grid, mean, {}, prior.model, {}};
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("where the samples contradict every model, their neighbours are asked, and it is said") {
    // A step in the azimuth of the view, which no random material has, at any unit.
    for (const float unit : {1e-4F, 1.0F, 1e4F}) {
        const auto step = [&](const LightAndView& pair) {
            const double side = std::sin(pair.view.phi + 0.3) > 0 ? 0.8 : 0.1;
            const auto value = static_cast<float>(side * std::cos(pair.light.theta));
            return unit * Rgb{value, value, value};
        };
        const std::vector<Rgb> samples = smallPrior().samplesOf(step);
        const auto reconstructor = methodFromName("prior").make(taskFor(samples));
        CHECK(reconstructor->remark().find("contradict") != std::string::npos);
        std::vector<Rgb> abrdf(smallPrior().grid.pairCount());
        std::vector<Rgb> neighbours(abrdf.size());
        reconstructor->reconstruct(samples, abrdf);
        methodFromName("idw").make(taskFor(samples))->reconstruct(samples, neighbours);
        CHECK(abrdf == neighbours);
    }
    const auto plain = methodFromName("prior").make(taskFor(smallPrior().samplesOf(plastic)));
    CHECK(plain->remark().empty());
    CHECK(plain->condition() > 10);
}

TEST_CASE("a model of other samples or another grid is refused") {
    ReconstructionTask task = taskFor(smallPrior().samplesOf(plastic));
    task.output = AngularGrid(ubo81Directions());
    CHECK_THROWS_AS(methodFromName("prior").make(task), std::invalid_argument);
    task.prior = nullptr;
    CHECK_THROWS_AS(methodFromName("prior").make(task), std::invalid_argument);
}

TEST_CASE("an ABRDF and its estimate have the same bits with the registers of every processor") {
    const SmallPrior& prior = smallPrior();
    for (const int rank : {0, 8}) {
        std::vector<Rgb> first;
        std::vector<float> firstEstimates;
        for (const int bytes : {16, 32, 64}) {
            const RegisterLimit limit(bytes);
            ReconstructionTask task = taskFor(prior.samplesOf(plastic));
            task.options.rank = rank;
            const auto reconstructor = methodFromName("prior").make(task);
            AbrdfTile samples(3, prior.samples.count());
            for (std::size_t t = 0; t < samples.texelCount(); ++t) {
                for (std::size_t k = 0; k < samples.valuesPerTexel(); ++k) {
                    samples[t][k] = (0.2F + 0.1F * static_cast<float>((t * 7 + k * 3) % 5)) *
                                    plastic(prior.samples.directions[k]);
                }
            }
            const ReconstructedTexels texels =
                reconstructTexels(samples, prior.grid, *reconstructor);
            const auto values = texels.abrdfs.values();
            if (first.empty()) first.assign(values.begin(), values.end());
            if (firstEstimates.empty()) firstEstimates = texels.estimates;
            CHECK(std::ranges::equal(values, first));
            CHECK(texels.estimates == firstEstimates);
        }
    }
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("a texel's ABRDF has the same bits alone, among others, and on any number of threads") {
    const SmallPrior& prior = smallPrior();
    AbrdfTile samples(75, prior.samples.count());
    for (std::size_t t = 0; t < samples.texelCount(); ++t) {
        for (std::size_t k = 0; k < samples.valuesPerTexel(); ++k) {
            samples[t][k] = (0.2F + 0.01F * static_cast<float>((t * 7 + k * 3) % 50)) *
                            plastic(prior.samples.directions[k]);
        }
    }
    const auto reconstructor = methodFromName("prior").make(taskFor(prior.samplesOf(plastic)));
    std::vector<Rgb> first;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const ReconstructedTexels texels = reconstructTexels(samples, prior.grid, *reconstructor);
        const auto values = texels.abrdfs.values();
        if (first.empty()) first.assign(values.begin(), values.end());
        CHECK(std::ranges::equal(values, first));
    }
    const std::size_t pairs = prior.grid.pairCount();
    for (const std::size_t texel : {0U, 31U, 32U, 74U}) {
        AbrdfTile one(1, prior.samples.count());
        std::ranges::copy(samples[texel], one[0].begin());
        const ReconstructedTexels alone = reconstructTexels(one, prior.grid, *reconstructor);
        CHECK(std::ranges::equal(alone.abrdfs[0], std::span(first).subspan(texel * pairs, pairs)));
    }
}

TEST_SUITE_END();
