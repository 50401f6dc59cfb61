// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/sweep.h"

#include "abrdf/pair_features.h"
#include "abrdf/stopwatch.h"
#include "pipeline/input_samples.h"
#include "stages/slice/choose_samples.h"
#include "stages/slice/slice_texels.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

std::vector<MethodSize> methodSizes(const std::vector<std::string>& methods,
                                    const std::vector<std::size_t>& counts,
                                    const std::vector<int>& ranks) {
    std::vector<MethodSize> sizes;
    for (const std::string& name : methods) {
        const Method& method = methodFromName(name);
        if (method.wish == SampleWish::kEverything) continue;
        for (const std::size_t count : counts) {
            for (const int rank : ranks) {
                if (method.needsPrior && static_cast<std::size_t>(rank) < count) {
                    sizes.push_back({name, count, rank});
                }
            }
            sizes.push_back({name, count, 0});
        }
    }
    return sizes;
}

Subject readSubject(const InputOptions& options, const ProgressSink& progress) {
    const OpenedInput input = openInput(options);
    const BtfDescription& description = input.description();
    const SampleSet everything =
        samplesFor(methodFromName("measured"), {}, input, description.grid);
    Subject subject{description.source,
                    description.grid,
                    {},
                    input.hasCodes() ? kNoiseOfCodes : 0,
                    input.hasCodes() ? kSaturatedCodes : 0};
    subject.truth = readStack(input, everything, {1, 1}, progress).stack;
    const ColorTransform toRec709 = input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)");
    for (std::size_t pair = 0; pair < subject.grid.pairCount(); ++pair) {
        toRec709.apply(subject.truth.image(pair));
    }
    return subject;
}

namespace {

std::vector<Rgb> valuesOf(const ImageStack& truth) {
    std::vector<Rgb> values;
    for (std::size_t pair = 0; pair < truth.pairs().size(); ++pair) {
        values.push_back(truth.image(pair)[0]);
    }
    return values;
}

ReconstructionTask taskOf(const MethodSize& size, const Method& method, const SamplePlan& plan,
                          const Subject& subject, const TrialOptions& options) {
    ReconstructionTask task;
    task.samples = chooseSamples(plan, subject.grid, method.wish);
    task.input = subject.grid;
    task.output = subject.grid;
    if (plan.posterSlices) task.plan = *plan.posterSlices;
    task.options.exposure = options.exposure;
    task.options.noise = subject.noise;
    task.options.saturated = subject.saturated;
    task.options.rank = size.rank;
    task.options.centered = false;  // Exact for the mean, a small model of one texel saves nothing.
    return task;
}

}  // namespace

Trial tryMethod(const MethodSize& size, const Subject& subject, const TrialOptions& options,
                const ProgressSink& progress, const MessageSink& warn) {
    const Method& method = methodFromName(size.method);
    const bool needsSlices = method.wish == SampleWish::kSlices;
    const PlanChoice choice{fmt::format("{}:{}", needsSlices ? "poster" : "greedy", size.samples)};
    const SamplePlan plan = planFor(method, choice, subject.grid, {}, false, progress, warn);
    ReconstructionTask task = taskOf(size, method, plan, subject, options);
    const SlicedTexels sliced = sliceTexels(subject.truth, task.samples, 0, 1);
    task.mean.assign(sliced.samples[0].begin(), sliced.samples[0].end());
    if (method.needsPrior) {
        task.prior = priorFor(task.samples.directions, distinctPairs(pairsOf(task.output)).distinct,
                              options.prior, progress, warn);
    }
    Trial trial;
    trial.size = size;
    trial.plan = plan.name;
    trial.samples = task.samples.count();
    trial.images = task.samples.pairs.size();
    const Stopwatch time;
    const auto reconstructor = method.make(task);
    trial.setUpMilliseconds = 1e3 * time.seconds();
    const AbrdfTile abrdf = reconstructTexels(sliced.samples, subject.grid, *reconstructor).abrdfs;
    trial.accuracy = measureAccuracy(valuesOf(subject.truth), abrdf[0], {}, {options.exposure});
    trial.time =
        timeMethod(*reconstructor, sliced.samples[0], subject.grid.pairCount(), options.seconds);
    trial.multiplyAdds = reconstructor->multiplyAdds();
    trial.modelBytes = reconstructor->modelBytes();
    return trial;
}

}  // namespace abrdf
