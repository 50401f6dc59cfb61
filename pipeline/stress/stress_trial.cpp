// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress_trial.h"

#include "abrdf/real_light.h"
#include "stages/measure/measures.h"
#include "stages/slice/choose_samples.h"
#include "stages/slice/slice_texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace abrdf {

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// An image of one texel a sample, as reading leaves them: NaN where there is no light.
ImageStack photographed(const StressTrial& trial, const SampleSet& samples, Random& random) {
    std::vector<std::size_t> images(samples.count());
    for (std::size_t k = 0; k < images.size(); ++k) images[k] = k;
    ImageStack stack(images, 1, 1);
    for (std::size_t k = 0; k < images.size(); ++k) {
        const LightAndView& pair = samples.directions[k];
        const Rgb value = trial.measured ? trial.measured(pair, random) : trial.truth.value(pair);
        stack.image(k)[0] = isLight(value) ? value : Rgb{kNaN, kNaN, kNaN};
    }
    return stack;
}

/// The samples that are left, as a database with gaps leaves them: methods on slices get their
/// neighbours' values instead, others do without.
struct LeftSamples {
    SampleSet set;
    ImageStack stack;
    std::vector<std::size_t> kept;  ///< Of the model's samples.
};

LeftSamples withGaps(const StressMethod& method, const StressTrial& trial, SampleSet samples,
                     ImageStack stack, Random& random) {
    LeftSamples left;
    const std::vector<bool> isKept = trial.kept ? trial.kept(samples.directions, random)
                                                : std::vector<bool>(samples.count(), true);
    for (std::size_t k = 0; k < isKept.size(); ++k) {
        if (isKept[k]) left.kept.push_back(k);
    }
    if (method.method->wish == SampleWish::kSlices) {
        for (std::size_t k = 0; k < isKept.size(); ++k) {
            if (!isKept[k]) stack.image(k)[0] = {kNaN, kNaN, kNaN};
        }
        left.set = std::move(samples);
        left.stack = std::move(stack);
        return left;
    }
    std::vector<LightAndView> directions;
    std::vector<std::size_t> images;
    for (const std::size_t k : left.kept) {
        images.push_back(directions.size());
        directions.push_back(samples.directions[k]);
    }
    left.stack = ImageStack(images, 1, 1);
    for (std::size_t i = 0; i < left.kept.size(); ++i) {
        left.stack.image(i)[0] = stack.image(left.kept[i])[0];
    }
    left.set = exactSamples(std::move(directions));
    return left;
}

StressOutcome compared(const StressTrial& trial, const AngularGrid& grid,
                       std::span<const Rgb> answer, std::span<const Rgb> samples) {
    StressOutcome outcome;
    std::vector<Rgb> truth;
    std::vector<std::uint8_t> mask;
    float largest = 0;
    for (std::size_t i = 0; i < answer.size(); ++i) {
        const LightAndView pair = grid.pair(i);
        truth.push_back(trial.truth.value(pair));
        mask.push_back(std::max(pair.light.theta, pair.view.theta) >= trial.leastTheta ? 1 : 0);
        outcome.isUnreal = outcome.isUnreal || !isLight(answer[i]);
        largest = std::max({largest, answer[i].r, answer[i].g, answer[i].b});
    }
    float largestSample = 0;
    for (const Rgb& c : samples) largestSample = std::max({largestSample, c.r, c.g, c.b});
    outcome.largest = largestSample > 0 ? static_cast<double>(largest / largestSample) : 0;
    outcome.deltaE = measureAccuracy(truth, answer, mask, {trial.exposure}).natural.deltaE;
    return outcome;
}

/// How far the answer is from the twin's, after both were made lights of.
void compareWithTwin(std::span<const Rgb> answer, std::span<const Rgb> samples,
                     const TwinAnswer& twin, double exposure, StressOutcome& outcome) {
    const auto most = static_cast<double>(mostOfSamples(samples));
    std::vector<Rgb> rounded;
    double difference2 = 0;
    double sum2 = 0;
    for (std::size_t i = 0; i < answer.size(); ++i) {
        const std::array<float, 3> own{answer[i].r, answer[i].g, answer[i].b};
        std::array<double, 3> value = twin.abrdf[i];
        for (std::size_t c = 0; c < 3; ++c) {
            value[c] = std::clamp(value[c], 0.0, most);
            difference2 += std::pow(static_cast<double>(own[c]) - value[c], 2);
            sum2 += value[c] * value[c];
        }
        rounded.push_back({static_cast<float>(value[0]), static_cast<float>(value[1]),
                           static_cast<float>(value[2])});
    }
    outcome.twin = TwinDifference{twin.condition,
                                  measureAccuracy(rounded, answer, {}, {exposure}).natural.deltaE,
                                  sum2 > 0 ? std::sqrt(difference2 / sum2) : 0};
}

}  // namespace

SampleSet stressSamples(const StressMethod& method, const StressTrial& trial,
                        const AngularGrid& grid) {
    const SamplePlan& plan = trial.plan ? *trial.plan : method.plan;
    if (method.method->wish == SampleWish::kSlices) {
        const SamplePlan& own = plan.posterSlices ? plan : method.plan;
        return exactSamples(own.posterSlices->samples());
    }
    if (trial.exactPlaces) return exactSamples(plan.samples);
    return exactSamples(chooseSamples(plan, grid, SampleWish::kMeasuredPairs).directions);
}

StressOutcome runStressTrial(const StressMethod& method, const StressTrial& trial,
                             const SampleSet& samples, const AngularGrid& grid,
                             const std::shared_ptr<const PriorModel>& model, std::uint64_t seed,
                             bool withTwin) {
    Random random(seed);
    ImageStack stack = photographed(trial, samples, random);
    const LeftSamples left = withGaps(method, trial, samples, std::move(stack), random);
    const AngularGrid& output = trial.grid ? *trial.grid : grid;
    ReconstructionTask task;
    task.samples = left.set;
    task.input = grid;
    task.output = output;
    const SamplePlan& plan = trial.plan && trial.plan->posterSlices ? *trial.plan : method.plan;
    if (plan.posterSlices) task.plan = *plan.posterSlices;
    task.options.exposure = trial.exposure;
    task.options.noise = trial.noise;
    task.options.saturated = trial.saturated;
    try {
        if (method.method->needsPrior) {
            task.mean = meanSamples(left.stack.pairs(), left.stack.values(), left.set);
            task.prior = left.kept.size() == samples.count()
                             ? model
                             : std::make_shared<const PriorModel>(withSamples(*model, left.kept));
        }
        const auto reconstructor = method.method->make(task);
        const SlicedTexels sliced = sliceTexels(left.stack, left.set, 0, 1);
        const AbrdfTile answer = reconstructTexels(sliced.samples, output, *reconstructor).abrdfs;
        StressOutcome outcome = compared(trial, output, answer[0], sliced.samples[0]);
        outcome.condition = reconstructor->condition();
        if (withTwin && method.method->twin != nullptr && reconstructor->remark().empty()) {
            task.mean.assign(sliced.samples[0].begin(), sliced.samples[0].end());
            compareWithTwin(answer[0], sliced.samples[0], method.method->twin(task), trial.exposure,
                            outcome);
        }
        return outcome;
    } catch (const std::exception& error) {
        StressOutcome refused;
        refused.deltaE = std::numeric_limits<double>::quiet_NaN();
        refused.refusal = error.what();
        return refused;
    }
}

}  // namespace abrdf
