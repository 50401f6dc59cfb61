// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/train/error_scale.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/scene_pairs.h"
#include "color/delta_e.h"
#include "stages/measure/quantile.h"
#include "stages/reconstruct/grey_prior.h"
#include "stages/reconstruct/leave_out.h"
#include "stages/train/random_material.h"
#include "stages/train/training_values.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr std::size_t kMaterials = 200;
constexpr std::uint64_t kSeed = 0x5ca1e;  ///< Unlike any that models are trained with.
constexpr std::size_t kOutputs = 400;
constexpr double kQuantile = 0.95;

/// Where both errors are below this they say nothing: dark materials.
constexpr double kLeastDeltaE = 0.1;

/// A grey's Delta E is its difference in lightness. shares: of each value, all sum to 1.
double meanDeltaE(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                  const std::vector<float>& shares, double exposure) {
    double sum = 0;
    for (Eigen::Index i = 0; i < a.size(); ++i) {
        sum += static_cast<double>(shares[static_cast<std::size_t>(i)]) *
               std::abs(lightness(a(i) * exposure) - lightness(b(i) * exposure));
    }
    return sum;
}

struct Trial {
    double isotropicShare = 0;
    double trueError = 0;
    double leftOutError = 0;
};

/// The model for some of its outputs: every k-th, or as their weights are.
PriorModel withSomeOutputs(const PriorModel& whole, std::span<const double> weights) {
    if (!weights.empty()) return withOutputs(whole, spreadByWeight(weights, kOutputs));
    std::vector<std::size_t> kept;
    const std::size_t step = (whole.outputs.size() + kOutputs - 1) / kOutputs;
    for (std::size_t i = step / 2; i < whole.outputs.size(); i += step) kept.push_back(i);
    return withOutputs(whole, kept);
}

std::vector<Trial> trialsOf(const PriorModel& model, double exposure) {
    const GreyPrior prior(model);
    const std::vector<VectorPair> samples = vectorPairs(model.samples);
    const std::vector<VectorPair> outputs = vectorPairs(model.outputs);
    const std::vector<float> equal(outputs.size(), 1.0F / static_cast<float>(outputs.size()));
    std::vector<Trial> trials(kMaterials);
    forEachImage(kMaterials, [&](std::size_t i) {
        Random random(kSeed, i);
        const PreparedMaterial material(
            randomMaterial(kMaterialClasses[i % kMaterialClasses.size()], random));
        const Eigen::VectorXd atSamples = valuesOf(material, samples);
        const GreyEstimate estimate = prior.estimate(atSamples);
        trials[i] = {estimate.isotropicShare,
                     meanDeltaE(estimate.outputs, valuesOf(material, outputs), equal, exposure),
                     meanDeltaE(estimate.leftOut, atSamples, prior.shares(), exposure)};
    });
    return trials;
}

}  // namespace

ErrorScale learnErrorScale(const PriorModel& model, double exposure,
                           std::span<const double> weights) {
    const PriorModel some = withSomeOutputs(model, weights);
    std::vector<float> ratios;
    for (const Trial& trial : trialsOf(some, exposure)) {
        const double most = std::max(trial.trueError, trial.leftOutError);
        if (most < kLeastDeltaE || trial.isotropicShare >= kIsotropicShare) continue;
        ratios.push_back(static_cast<float>(trial.trueError / std::max(trial.leftOutError, 1e-9)));
    }
    ErrorScale scale;
    if (!ratios.empty()) scale.other = static_cast<double>(quantile(ratios, kQuantile));
    // Isotropic random materials are too easy to learn from. Their samples have nearer neighbours
    // among the outputs; part of an error falls with that distance and part, noise, does not: its
    // root.
    const SampleBlocks blocks = leaveOutBlocks(model.samples);
    const std::vector<LightAndView>& outputs = weights.empty() ? model.outputs : some.outputs;
    scale.isotropic =
        scale.other * std::sqrt(nearness(model.samples, blocks, outputs, true) /
                                std::max(nearness(model.samples, blocks, outputs, false), 1e-9));
    return scale;
}

}  // namespace abrdf
