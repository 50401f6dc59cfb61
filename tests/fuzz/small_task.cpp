// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/small_task.h"

#include "stages/slice/choose_samples.h"
#include "stages/train/model_file.h"
#include "tests/fuzz/targets.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <algorithm>

namespace abrdf {

const ReconstructionTask& smallTask() {
    static const ReconstructionTask kTask = [] {
        ReconstructionTask task;
        std::vector<Direction> directions = {{0, 0}};
        for (const double theta : {30.0, 70.0}) {
            for (int k = 0; k < 4; ++k) {
                directions.push_back({radiansFromDegrees(theta), kPi / 2 * k});
            }
        }
        task.input = task.output = AngularGrid(directions);
        SamplePlan plan;
        for (std::size_t pair = 0; pair < task.input.pairCount(); pair += 7) {
            plan.samples.push_back(task.input.pair(pair));
        }
        task.samples = chooseSamples(plan, task.input, SampleWish::kMeasuredPairs);
        task.prior = std::make_shared<const PriorModel>(
            trainPrior(task.samples.directions, pairsOf(task.output), {12, 1}, {}));
        return task;
    }();
    return kTask;
}

std::string smallModelBytes() {
    const TemporaryFolder folder;
    writeModel(folder.path() / "model", *smallTask().prior);
    return bytesOf(folder.path() / "model");
}

void reconstructAndCheck(const Reconstructor& reconstructor, const AngularGrid& output,
                         std::span<const Rgb> samples, std::size_t texels) {
    const std::size_t own = samples.size() / texels;
    const std::size_t pairs = output.pairCount();
    const std::size_t step = std::max<std::size_t>(1, reconstructor.texelsAtOnce());
    std::vector<Rgb> abrdfs(texels * pairs);
    for (std::size_t begin = 0; begin < texels; begin += step) {
        const std::size_t count = std::min(step, texels - begin);
        reconstructBlock(samples.subspan(begin * own, count * own), count, reconstructor,
                         std::span(abrdfs).subspan(begin * pairs, count * pairs));
    }
    for (std::size_t t = 0; t < texels; ++t) {
        float largest = 0;
        for (const Rgb& c : samples.subspan(t * own, own)) {
            largest = std::max({largest, c.r, c.g, c.b});
        }
        for (const Rgb& c : std::span(abrdfs).subspan(t * pairs, pairs)) {
            fuzzCheck(isFinite(c), "no NaN and no infinity leaves a method");
            fuzzCheck(c.r >= 0 && c.g >= 0 && c.b >= 0, "no negative value leaves a method");
            fuzzCheck(std::max({c.r, c.g, c.b}) <= 1.001F * kMostOfSamples * largest,
                      "no value leaves a method that is brighter than four times the samples");
        }
    }
}

}  // namespace abrdf
