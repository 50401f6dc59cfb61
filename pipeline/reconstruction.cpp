// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/reconstruction.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"
#include "stages/slice/slice_texels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

constexpr double kNoiseOfCodes = 0.01;
constexpr double kSaturatedCodes = 0.99;

/// More do not change a choice.
constexpr std::size_t kSomeTexels = 64;

/// The mean of an image's valid texels; NaN where there is none.
Rgb meanOf(std::span<const Rgb> image) {
    double sum[3] = {};
    double count = 0;
    for (const Rgb& c : image) {
        if (!isFinite(c)) continue;
        sum[0] += static_cast<double>(c.r);
        sum[1] += static_cast<double>(c.g);
        sum[2] += static_cast<double>(c.b);
        ++count;
    }
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    if (count == 0) return {kNaN, kNaN, kNaN};
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
            static_cast<float>(sum[2] / count)};
}

/// The model for the samples that were planned, without those that are missing.
std::shared_ptr<const PriorModel> modelFor(const MethodChoice& choice, const PlannedMethod& planned,
                                           const ProgressSink& progress, const MessageSink& warn) {
    const SampleSet& samples = planned.samples;
    const std::vector<LightAndView> outputs = distinctPairs(pairsOf(planned.output)).distinct;
    if (samples.dropped.empty()) {
        return priorFor(samples.directions, outputs, choice.prior, progress, warn);
    }
    std::vector<LightAndView> all = samples.directions;
    all.insert(all.end(), samples.dropped.begin(), samples.dropped.end());
    std::vector<std::size_t> kept(samples.count());
    for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = k;
    return std::make_shared<const PriorModel>(
        withSamples(*priorFor(all, outputs, choice.prior, progress, warn), kept));
}

}  // namespace

std::string PlannedMethod::planName() const {
    return method->wish == SampleWish::kEverything ? "all" : plan.name;
}

PlannedMethod planMethod(const MethodChoice& choice, const OpenedInput& input,
                         const AngularGrid& output, const ProgressSink& progress) {
    PlannedMethod planned;
    planned.method = &methodFromName(choice.name);
    const AngularGrid& measured = input.description().grid;
    planned.plan = planFor(*planned.method, choice.plan, measured, input.reader->table() != nullptr,
                           progress, input.warn);
    planned.samples = samplesFor(*planned.method, planned.plan, input, output);
    planned.input = sampledGrid(*planned.method, input, output);
    planned.output = output;
    return planned;
}

std::vector<Rgb> meanSamples(const ImageStack& stack, const SampleSet& samples) {
    ImageStack means(stack.pairs(), 1, 1);
    forEachImage(stack.pairs().size(),
                 [&](std::size_t i) { means.image(i)[0] = meanOf(stack.image(i)); });
    const SlicedTexels sliced = sliceTexels(means, samples, 0, 1);
    return {sliced.samples[0].begin(), sliced.samples[0].end()};
}

std::vector<Rgb> samplesOfSomeTexels(const ImageStack& stack, const SampleSet& samples) {
    if (stack.texelCount() == 1) return {};
    // The additive sequence of the plastic number: as many as there are, evenly spread, in step
    // with no weave.
    constexpr double kStepX = 0.7548776662466927;
    constexpr double kStepY = 0.5698402909980532;
    const auto place = [](std::size_t i, double step, int count) {
        const double share = 0.5 + static_cast<double>(i) * step;
        return static_cast<std::size_t>((share - std::floor(share)) * count);
    };
    std::vector<Rgb> result;
    for (std::size_t i = 0; i < std::min(kSomeTexels, stack.texelCount()); ++i) {
        const std::size_t texel =
            place(i, kStepY, stack.height()) * static_cast<std::size_t>(stack.width()) +
            place(i, kStepX, stack.width());
        const SlicedTexels sliced = sliceTexels(stack, samples, texel, 1);
        result.insert(result.end(), sliced.samples[0].begin(), sliced.samples[0].end());
    }
    return result;
}

std::unique_ptr<Reconstructor> buildReconstructor(const MethodChoice& choice,
                                                  const PlannedMethod& planned,
                                                  const OpenedInput& input, const ImageStack& stack,
                                                  const ProgressSink& progress) {
    ReconstructionTask task;
    task.samples = planned.samples;
    task.input = planned.input;
    task.output = planned.output;
    if (planned.plan.posterSlices) task.plan = *planned.plan.posterSlices;
    task.options = choice.options;
    task.options.noise = choice.noise.value_or(input.hasCodes() ? kNoiseOfCodes : 0);
    task.options.saturated = choice.saturated.value_or(input.hasCodes() ? kSaturatedCodes : 0);
    if (planned.method->needsPrior) {
        task.mean = meanSamples(stack, planned.samples);
        task.someTexels = samplesOfSomeTexels(stack, planned.samples);
        task.prior = modelFor(choice, planned, progress, input.warn);
    }
    return planned.method->make(task);
}

}  // namespace abrdf
