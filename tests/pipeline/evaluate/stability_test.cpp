// SPDX-License-Identifier: BSD-3-Clause
//
// The prior on measured materials with fewer, noisier and lost samples, as far as these materials
// lie beside the checkout.
#include "abrdf/random.h"
#include "abrdf/sample_plan.h"
#include "color/delta_e.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/slice/choose_samples.h"
#include "stages/train/train_prior.h"
#include "tests/support/measured_materials.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

using namespace abrdf;

namespace {

/// The prior for the first `count` built-in pairs of UBO2003's grid.
struct GreedyPrior {
    explicit GreedyPrior(std::size_t count) {
        const AngularGrid grid(ubo81Directions());
        const std::vector<std::size_t>& built = greedyPairsOfUbo81();
        samples = chooseSamples(
            pairsPlan("greedy", grid,
                      {built.begin(), built.begin() + static_cast<std::ptrdiff_t>(count)}),
            grid, SampleWish::kMeasuredPairs);
        model = trainPrior(samples.directions, pairsOf(grid), {1000, 1}, {});
    }

    SampleSet samples;
    PriorModel model;
};

using Defect = std::function<Rgb(Rgb, Random&)>;

/// Mean Delta E at natural exposure over the materials. kept: of the samples; empty: all.
double meanError(const GreedyPrior& prior, const std::vector<std::vector<Rgb>>& tables,
                 const Defect& defect, const std::vector<std::size_t>& kept,
                 const ReconstructOptions& options) {
    const PriorModel model = kept.empty() ? prior.model : withSamples(prior.model, kept);
    std::vector<std::size_t> rows(tables.front().size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    double sum = 0;
    for (const std::vector<Rgb>& table : tables) {
        Random random(11);
        std::vector<Rgb> values;
        for (const std::size_t pair : prior.samples.pairs) {
            values.push_back(defect ? defect(table[pair], random) : table[pair]);
        }
        if (!kept.empty()) {
            std::vector<Rgb> left;
            for (const std::size_t k : kept) left.push_back(values[k]);
            values = left;
        }
        std::vector<Rgb> abrdf(table.size());
        PriorMaterial(model, rows, values, options).reconstruct(values, abrdf);
        sum += measureAccuracy(table, abrdf, {}, {}).natural.deltaE;
    }
    return sum / static_cast<double>(tables.size());
}

Defect noise(double sigma) {
    return [sigma](Rgb c, Random& random) {
        return static_cast<float>(std::max(0.0, 1 + sigma * random.normal())) * c;
    };
}

Rgb inEightBits(Rgb c, Random&) {
    const auto code = [](float v) {
        return static_cast<float>(
            linearFromSrgb(std::round(255 * srgbEncoded(static_cast<double>(v))) / 255));
    };
    return {code(c.r), code(c.g), code(c.b)};
}

}  // namespace

TEST_SUITE_BEGIN("slow");

TEST_CASE("on measured materials more samples help, and lost or noisy ones cost little") {
    const auto tables = measuredMaterials();
    if (tables.empty()) {
        MESSAGE("skipped: there are no measured materials beside this checkout");
        return;
    }
    const GreedyPrior few(52);
    const GreedyPrior more(100);
    const GreedyPrior full(204);
    const double at52 = meanError(few, tables, {}, {}, {});
    const double at100 = meanError(more, tables, {}, {}, {});
    const double clean = meanError(full, tables, {}, {}, {});
    CHECK(at100 <= at52 + 0.1);
    CHECK(clean <= at100 + 0.1);
    std::vector<std::size_t> half;
    Random random(4);
    for (std::size_t k = 0; k < 204; ++k) {
        if (random.chance(0.5)) half.push_back(k);
    }
    const double halved = meanError(full, tables, {}, half, {});
    const double one = meanError(full, tables, noise(0.01), {}, {.noise = 0.01});
    const double five = meanError(full, tables, noise(0.05), {}, {.noise = 0.05});
    const double coded =
        meanError(full, tables, inEightBits, {}, {.noise = 0.01, .saturated = 0.99});
    CHECK(halved <= clean + 0.7);
    CHECK(one <= clean + 0.1);
    CHECK(five <= clean + 0.4);
    CHECK(coded <= clean + 0.15);
    MESSAGE("52: " << at52 << ", 100: " << at100 << ", 204: " << clean
                   << "; of these, half lost: " << halved << ", 1 % noise: " << one
                   << ", 5 %: " << five << ", 8 bits: " << coded);
}

TEST_SUITE_END();
