// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/reconstruction.h"

#include "abrdf/pair_features.h"
#include "pipeline/input_samples.h"
#include "pipeline/train/error_scale.h"
#include "stages/slice/slice_texels.h"

#include <algorithm>
#include <filesystem>

namespace abrdf {

namespace {

/// The model for the samples that were planned, without those that are missing.
std::shared_ptr<const PriorModel> modelFor(const MethodChoice& choice, const PlannedMethod& planned,
                                           const ProgressSink& progress, const MessageSink& warn) {
    const SampleSet& samples = planned.samples;
    const std::vector<LightAndView> outputs = distinctPairs(pairsOf(planned.output)).distinct;
    std::shared_ptr<const PriorModel> model;
    if (samples.dropped.empty()) {
        model = priorFor(samples.directions, outputs, choice.prior, progress, warn);
    } else {
        std::vector<LightAndView> all = samples.directions;
        all.insert(all.end(), samples.dropped.begin(), samples.dropped.end());
        std::vector<std::size_t> kept(samples.count());
        for (std::size_t k = 0; k < kept.size(); ++k) kept[k] = k;
        model = std::make_shared<const PriorModel>(
            withSamples(*priorFor(all, outputs, choice.prior, progress, warn), kept));
    }
    if (planned.weights.empty()) return model;
    // What errors are over the pairs that matter is another matter than over all.
    auto weighed = std::make_shared<PriorModel>(*model);
    std::vector<double> weights(outputs.size());
    const std::vector<std::size_t> rowOf = distinctPairs(pairsOf(planned.output)).rowOf;
    for (std::size_t pair = 0; pair < rowOf.size(); ++pair) {
        weights[rowOf[pair]] += planned.weights[pair];
    }
    weighed->errorScale = learnErrorScale(*weighed, 1, weights);
    return weighed;
}

/// Is the plan one to be made for a scene? Of so many samples at most.
std::optional<std::size_t> sceneBound(const MethodChoice& choice, const Method& method) {
    if (method.wish != SampleWish::kMeasuredPairs) return {};
    if (choice.plan.isOpen()) return kPlanSamples;
    if (std::filesystem::is_regular_file(choice.plan.name) || choice.plan.name.empty()) return {};
    const PlanName name = planNameFrom(choice.plan.name);
    if (name.base != "greedy") return {};
    return name.bound > 0 ? name.bound : kPlanSamples;
}

}  // namespace

std::string PlannedMethod::planName() const {
    return method->wish == SampleWish::kEverything ? "all" : plan.name;
}

PlannedMethod planMethod(const MethodChoice& choice, const OpenedInput& input,
                         const AngularGrid& output, const ProgressSink& progress,
                         const SceneChoice* scene) {
    PlannedMethod planned;
    planned.method = &methodFromName(choice.name);
    const AngularGrid& measured = input.description().grid;
    std::optional<std::size_t> bound;
    if (scene != nullptr) {
        planned.weights = scene->outputs.weights;
        bound = sceneBound(choice, *planned.method);
    }
    if (bound) {
        ScenePlan made =
            scenePlan(scene->outputs, output, measured, input.description().present,
                      {*bound, scene->planIsOpen, choice.options.tolerance}, progress, input.warn);
        planned.plan = std::move(made.plan);
        planned.expectedError = made.expectedError;
    } else {
        planned.plan = planFor(*planned.method, choice.plan, measured, input.description().present,
                               input.reader->table() != nullptr, progress, input.warn);
    }
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
    task.options.weights = planned.weights;
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
