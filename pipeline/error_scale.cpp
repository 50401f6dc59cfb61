// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/error_scale.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "stages/measure/quantile.h"
#include "stages/reconstruct/grey_prior.h"
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

/// Below this both errors are of no importance.
constexpr double kLeastDeltaE = 0.05;

/// A grey's Delta E is its difference in lightness.
double meanDeltaE(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double exposure) {
    double sum = 0;
    for (Eigen::Index i = 0; i < a.size(); ++i) {
        sum += std::abs(lightness(a(i) * exposure) - lightness(b(i) * exposure));
    }
    return sum / static_cast<double>(a.size());
}

struct Trial {
    bool isIsotropic = false;
    double trueError = 0;
    double leftOutError = 0;
};

std::vector<Trial> trialsOf(const PriorModel& whole, double exposure) {
    std::vector<std::size_t> kept;
    const std::size_t step = (whole.outputs.size() + kOutputs - 1) / kOutputs;
    for (std::size_t i = step / 2; i < whole.outputs.size(); i += step) kept.push_back(i);
    const PriorModel model = withOutputs(whole, kept);
    const GreyPrior prior(model);
    const std::vector<VectorPair> samples = vectorPairs(model.samples);
    const std::vector<VectorPair> outputs = vectorPairs(model.outputs);
    std::vector<Trial> trials(kMaterials);
    forEachImage(kMaterials, [&](std::size_t i) {
        Random random(kSeed, i);
        const PreparedMaterial material(
            randomMaterial(kMaterialClasses[i % kMaterialClasses.size()], random));
        const auto valuesAt = [&](const std::vector<VectorPair>& pairs) {
            std::vector<float> values(pairs.size());
            material.evaluate(pairs, values);
            return Eigen::VectorXd(
                Eigen::Map<Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size()))
                    .cast<double>());
        };
        const Eigen::VectorXd atSamples = valuesAt(samples);
        const GreyEstimate estimate = prior.estimate(atSamples);
        trials[i] = {estimate.isotropicShare > 0.5,
                     meanDeltaE(estimate.outputs, valuesAt(outputs), exposure),
                     meanDeltaE(estimate.leftOut, atSamples, exposure)};
    });
    return trials;
}

}  // namespace

ErrorScale learnErrorScale(const PriorModel& model, double exposure) {
    std::vector<float> isotropic;
    std::vector<float> other;
    for (const Trial& trial : trialsOf(model, exposure)) {
        const double ratio =
            std::max(trial.trueError, kLeastDeltaE) / std::max(trial.leftOutError, kLeastDeltaE);
        (trial.isIsotropic ? isotropic : other).push_back(static_cast<float>(ratio));
    }
    std::vector<float> all = isotropic;
    all.insert(all.end(), other.begin(), other.end());
    constexpr std::size_t kFew = 20;  // Too few to have a quantile of their own.
    const auto quantileOf = [&](const std::vector<float>& ratios) {
        return static_cast<double>(quantile(ratios.size() < kFew ? all : ratios, kQuantile));
    };
    return {quantileOf(isotropic), quantileOf(other)};
}

double expectedError(const PriorModel& model, double exposure) {
    double sum = 0;
    const std::vector<Trial> trials = trialsOf(model, exposure);
    for (const Trial& trial : trials) sum += trial.trueError;
    return sum / static_cast<double>(trials.size());
}

}  // namespace abrdf
