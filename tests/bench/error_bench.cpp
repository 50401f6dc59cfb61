// SPDX-License-Identifier: BSD-3-Clause
//
// What the prior says of its own error, beside the truth, and what a tolerance saves: the table
// "Knowing the error" of README.md, over the measured materials at 1 x 1.
#include "pipeline/train/prior_cache.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/slice/choose_samples.h"
#include "tests/support/measured_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>

using namespace abrdf;

namespace {

constexpr std::array kTolerances = {0.5, 1.0, 2.0, 3.0, 4.0};

const AngularGrid& grid() {
    static const AngularGrid kGrid(ubo81Directions());
    return kGrid;
}

/// One material as one texel without a centre of its own.
struct Known {
    double truth = 0;  ///< Delta E.
    double bound = 0;
    double cost = 0;           ///< Multiply-adds.
    double costOfAllRows = 0;  ///< Of matrices with a row for every pair, isotropic twin or not.
};

/// Of one plan.
class Trial {
  public:
    explicit Trial(const SamplePlan& plan)
        : samples_(chooseSamples(plan, grid(), SampleWish::kMeasuredPairs)),
          model_(trainedModel(samples_.directions, pairsOf(grid()), {}, {})),
          rows_(grid().pairCount()) {
        std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    }

    /// tolerance 0: the whole model.
    Known operator()(const std::vector<Rgb>& table, double tolerance) const {
        std::vector<Rgb> values;
        for (const std::size_t pair : samples_.pairs) values.push_back(table[pair]);
        ReconstructOptions options;
        options.centered = false;
        options.tolerance = tolerance;
        const PriorMaterial material(model_, rows_, values, options);
        float bound = 0;
        const TexelCodes codes = material.encode(values, {&bound, 1});
        std::vector<Rgb> abrdf(table.size());
        material.model().evaluate(codes, abrdf);
        const double cost =
            tolerance > 0 ? material.multiplyAddsOfRank(codes.ranks[0]) : material.multiplyAdds();
        // A texel's floats are its vectors, as long as its samples, and at most six more.
        const auto count = static_cast<double>(samples_.count());
        const double vectors = std::floor(material.modelBytes() / sizeof(float) / count);
        return {measureAccuracy(table, abrdf, {}, {}).natural.deltaE, static_cast<double>(bound),
                cost, vectors * static_cast<double>(rows_.size()) * count};
    }

  private:
    SampleSet samples_;
    PriorModel model_;
    std::vector<std::size_t> rows_;
};

/// Counts over the materials and the tolerances.
struct Counts {
    std::size_t obeyed = 0;
    double worst = 0;
    std::size_t accepted = 0;
    std::size_t within = 0;
    std::size_t could = 0;
    std::size_t refused = 0;
    std::array<double, kTolerances.size()> costs{};       ///< Beside always-whole models.
    std::array<double, kTolerances.size()> costsOfAll{};  ///< Beside matrices of all pairs.
};

void printRow(const SamplePlan& plan, const std::vector<std::vector<Rgb>>& tables) {
    const Trial trial(plan);
    Counts counts;
    for (const std::vector<Rgb>& table : tables) {
        const Known whole = trial(table, 0);
        counts.obeyed += whole.truth <= whole.bound ? 1U : 0U;
        counts.worst = std::max(counts.worst, whole.truth / whole.bound);
        for (std::size_t t = 0; t < kTolerances.size(); ++t) {
            const Known known = trial(table, kTolerances[t]);
            const bool isAccepted = known.bound <= kTolerances[t];
            const bool could = whole.truth <= kTolerances[t];
            counts.accepted += isAccepted ? 1U : 0U;
            counts.within += isAccepted && known.truth <= kTolerances[t] ? 1U : 0U;
            counts.could += could ? 1U : 0U;
            counts.refused += could && !isAccepted ? 1U : 0U;
            const auto share = 1 / static_cast<double>(tables.size());
            counts.costs[t] += share * known.cost / whole.cost;
            counts.costsOfAll[t] += share * known.cost / whole.costOfAllRows;
        }
    }
    fmt::print(
        "| `{}` | {} / {} | {:.2f} | {} | {} | {} of {} | {:.2f}, {:.2f} | {:.2f}, {:.2f} |\n",
        plan.name, counts.obeyed, tables.size(), counts.worst, counts.accepted, counts.within,
        counts.refused, counts.could, counts.costs[2], counts.costs[4], counts.costsOfAll[2],
        counts.costsOfAll[4]);
    std::fflush(stdout);
}

}  // namespace

int main() {
    const std::vector<std::vector<Rgb>> tables = measuredMaterials();
    if (tables.empty()) {
        fmt::print("there are no measured materials beside this checkout\n");
        return 0;
    }
    fmt::print(
        "| plan | obeyed | worst true / bound | accepted | within | refused of | cost at 2, 4 "
        "| of all rows |\n");
    const std::vector<std::size_t>& greedy = greedyPairsOfUbo81();
    for (const std::ptrdiff_t count : {204, 100, 52}) {
        printRow(pairsPlan(fmt::format("greedy:{}", count), grid(),
                           {greedy.begin(), greedy.begin() + count}),
                 tables);
    }
    printRow(sixteenSlicesPlan(0, &grid()), tables);
    printRow(eightPlan(0, &grid()), tables);
    printRow(posterPlan({}), tables);
}
