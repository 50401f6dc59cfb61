// SPDX-License-Identifier: BSD-3-Clause
//
// How the prior's true error follows from what a plan leaves uncertain: the figures behind
// pipeline/plan/expected_error.cpp and the table "Plans" of README.md, of the plans that are built
// in or of those in the files given: natural and highlight Delta E and PSNR, random and measured.
#include "pipeline/plan/expected_error.h"
#include "pipeline/plan/plan_file.h"
#include "stages/measure/measures.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/slice/choose_samples.h"
#include "stages/train/conditioned_class.h"
#include "stages/train/random_material.h"
#include "stages/train/train_prior.h"
#include "stages/train/training_values.h"
#include "tests/support/measured_materials.h"

#include <fmt/format.h>

#include <numeric>

using namespace abrdf;

namespace {

const AngularGrid& grid() {
    static const AngularGrid kGrid(ubo81Directions());
    return kGrid;
}

/// Tables of materials that no training has seen.
std::vector<std::vector<Rgb>> unseenMaterials(std::size_t ofEachClass) {
    std::vector<std::vector<Rgb>> tables;
    const std::vector<VectorPair> pairs = vectorPairs(pairsOf(grid()));
    for (const MaterialClass materialClass : kMaterialClasses) {
        std::vector<PreparedMaterial> materials;
        for (const AnalyticMaterial& m : randomMaterials(materialClass, ofEachClass, 4711)) {
            materials.emplace_back(m);
        }
        const Eigen::MatrixXf values = valuesOf(materials, pairs);
        for (Eigen::Index m = 0; m < values.cols(); ++m) {
            std::vector<Rgb> table;
            for (const float v : values.col(m)) table.push_back({v, v, v});
            tables.push_back(std::move(table));
        }
    }
    return tables;
}

Accuracy meanAccuracy(const PriorModel& model, const SampleSet& samples,
                      const std::vector<std::vector<Rgb>>& tables) {
    std::vector<std::size_t> rows(grid().pairCount());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    Accuracy mean;
    const auto share = 1 / static_cast<double>(tables.size());
    for (const std::vector<Rgb>& table : tables) {
        std::vector<Rgb> values;
        for (const std::size_t pair : samples.pairs) values.push_back(table[pair]);
        std::vector<Rgb> abrdf(grid().pairCount());
        PriorMaterial(model, rows, values, {}).reconstruct(values, abrdf);
        const Accuracy a = measureAccuracy(table, abrdf, {}, {});
        mean.natural.deltaE += share * a.natural.deltaE;
        mean.natural.psnr += share * a.natural.psnr;
        mean.highlight.deltaE += share * a.highlight.deltaE;
        mean.highlight.psnr += share * a.highlight.psnr;
    }
    return mean;
}

struct Materials {
    std::vector<std::vector<Rgb>> random;
    std::vector<std::vector<Rgb>> measured;
};

void printRow(const SamplePlan& plan, const Materials& materials) {
    const SampleSet samples = chooseSamples(plan, grid(), SampleWish::kMeasuredPairs);
    std::vector<ConditionedClass> classes = conditionedClasses(grid(), samples.directions, {});
    for (std::size_t k = 0; k < samples.count(); ++k) {
        for (ConditionedClass& c : classes) c.choose(static_cast<Eigen::Index>(k));
    }
    const Uncertainty left = uncertaintyOf(classes);
    const PriorModel model = trainPrior(samples.directions, pairsOf(grid()), {}, {});
    fmt::print("{:<16} {:4} {:8.4f} {:6.2f}", plan.name, samples.count(), left.deviation,
               expectedErrorOf(left.deviation));
    for (const auto& tables : {materials.random, materials.measured}) {
        if (tables.empty()) continue;
        const Accuracy a = meanAccuracy(model, samples, tables);
        fmt::print(" | {:5.2f} / {:4.1f}  {:5.2f} / {:4.1f}", a.natural.deltaE, a.natural.psnr,
                   a.highlight.deltaE, a.highlight.psnr);
    }
    fmt::print("\n");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const Materials materials{unseenMaterials(12), measuredMaterials()};
    fmt::print("plan  samples  deviation  expected | random natural, highlight | measured\n");
    for (int i = 1; i < argc; ++i) printRow(planFromFile(argv[i]), materials);
    if (argc > 1) return 0;
    for (const std::size_t count : {8U, 16U, 28U, 52U, 100U, 204U, 408U}) {
        const std::vector<std::size_t>& pairs = greedyPairsOfUbo81();
        printRow(pairsPlan(fmt::format("greedy:{}", count), grid(),
                           {pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count)}),
                 materials);
    }
    for (const std::size_t count : {52U, 100U, 204U}) {
        printRow(sixteenSlicesPlan(count, &grid()), materials);
        printRow(eightPlan(count, &grid()), materials);
    }
    printRow(posterPlan({}), materials);
}
