// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/reconstruction.h"

#include "abrdf/pair_features.h"
#include "stages/slice/slice_texels.h"

#include <algorithm>

namespace abrdf {

namespace {

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
    planned.plan = planFor(*planned.method, choice.plan, measured, input.description().present,
                           input.reader->table() != nullptr, progress, input.warn);
    planned.samples = samplesFor(*planned.method, planned.plan, input, output);
    planned.input = sampledGrid(*planned.method, input, output);
    planned.output = output;
    return planned;
}

std::vector<Rgb> meanSamples(std::span<const std::size_t> images, std::span<const Rgb> imageMeans,
                             const SampleSet& samples) {
    std::vector<Rgb> means(samples.count());
    TexelSlicer(images, samples).slice(imageMeans, 0, means);
    return means;
}

std::unique_ptr<Reconstructor> buildReconstructor(
    const MethodChoice& choice, const PlannedMethod& planned, const OpenedInput& input,
    std::span<const std::size_t> images, const ReadFacts& facts, const ProgressSink& progress) {
    ReconstructionTask task;
    task.samples = planned.samples;
    task.input = planned.input;
    task.output = planned.output;
    if (planned.plan.posterSlices) task.plan = *planned.plan.posterSlices;
    task.options = choice.options;
    task.options.noise = choice.noise.value_or(input.hasCodes() ? kNoiseOfCodes : 0);
    task.options.saturated = choice.saturated.value_or(input.hasCodes() ? kSaturatedCodes : 0);
    if (planned.method->needsPrior) {
        task.mean = meanSamples(images, facts.means, planned.samples);
        task.someTexels.resize(facts.someTexels.size() / images.size() * task.samples.count());
        TexelSlicer(images, planned.samples).slice(facts.someTexels, 0, task.someTexels);
        task.prior = modelFor(choice, planned, progress, input.warn);
    }
    return planned.method->make(task);
}

}  // namespace abrdf
