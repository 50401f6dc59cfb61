// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress_run.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"
#include "stages/measure/stress_figure.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>

namespace abrdf {

using nlohmann::ordered_json;

void StressRun::run(const ProgressSink& progress, const MessageSink& warn) {
    const std::size_t count = case_.steps.size() * materials_.size();
    std::vector<StressTrial> trials;
    for (std::size_t i = 0; i < count; ++i) {
        trials.push_back(case_.trial(materials_[i % materials_.size()],
                                     case_.steps[i / materials_.size()].value));
    }
    outcomes_.resize(count * methods_.size());
    std::vector<SampleSet> samples(outcomes_.size());
    std::vector<std::shared_ptr<const PriorModel>> models(outcomes_.size());
    for (std::size_t i = 0; i < outcomes_.size(); ++i) {
        const StressMethod& method = methods_[i % methods_.size()];
        const StressTrial& trial = trials[i / methods_.size()];
        samples[i] = stressSamples(method, trial, grid_);
        if (method.method->needsPrior) {
            models[i] = modelOf(samples[i], trial.grid ? *trial.grid : grid_, progress, warn);
        }
    }
    std::atomic<std::size_t> done = 0;
    forEachImage(outcomes_.size(), [&](std::size_t i) {
        const std::size_t trial = i / methods_.size();
        // Every method sees the same noise; every material and step another.
        const std::uint64_t seed = hashOf({options_.seed, trial, hashOfName()});
        outcomes_[i] = runStressTrial(methods_[i % methods_.size()], trials[trial], samples[i],
                                      grid_, models[i], seed, case_.hasTwin);
        if (progress) progress({case_.name, "trials", ++done, outcomes_.size()});
    });
}

ordered_json StressRun::resultOf(std::size_t method) const {
    ordered_json steps = ordered_json::array();
    std::vector<double> errors;
    std::string refusal;
    double condition = 1;
    std::size_t unreal = 0;
    for (std::size_t step = 0; step < case_.steps.size(); ++step) {
        double sum = 0;
        double worst = 0;
        double largest = 0;
        for (std::size_t m = 0; m < materials_.size(); ++m) {
            const StressOutcome& outcome =
                outcomes_[(step * materials_.size() + m) * methods_.size() + method];
            sum += outcome.deltaE;
            worst = std::max(worst, outcome.deltaE);
            largest = std::max(largest, outcome.largest);
            condition = std::max(condition, outcome.condition);
            unreal += outcome.isUnreal ? 1 : 0;
            if (!outcome.refusal.empty()) refusal = outcome.refusal;
        }
        errors.push_back(sum / static_cast<double>(materials_.size()));
        ordered_json row = {{"label", case_.steps[step].label}, {"value", case_.steps[step].value}};
        row["delta_e"] = std::isfinite(errors.back()) ? ordered_json(errors.back()) : nullptr;
        row["worst"] = std::isfinite(errors.back()) ? ordered_json(worst) : nullptr;
        row["largest"] = largest;
        if (const auto& twin = outcomes_[step * materials_.size() * methods_.size() + method].twin;
            twin) {  // Cases with twins bring the one material.
            row["condition"] = twin->condition;
            row["twin_delta_e"] = twin->deltaE;
            row["twin_relative"] = twin->relative;
        }
        steps.push_back(row);
    }
    const auto broken = breakdownStep(errors);
    ordered_json result = {{"case", case_.name},
                           {"method", methods_[method].method->name},
                           {"breakdown", broken ? case_.steps[*broken].label : "none"}};
    result["axis"] = case_.axis;
    result["steps"] = steps;
    result["condition"] = condition;
    result["unreal_values"] = unreal;
    if (!refusal.empty()) result["refusal"] = refusal;
    return result;
}

std::uint64_t StressRun::hashOfName() const {
    std::uint64_t hash = 0;
    for (const char c : case_.name) hash = hashOf({hash, static_cast<std::uint64_t>(c)});
    return hash;
}

std::shared_ptr<const PriorModel> StressRun::modelOf(const SampleSet& samples,
                                                     const AngularGrid& output,
                                                     const ProgressSink& progress,
                                                     const MessageSink& warn) {
    for (const auto& [ofSamples, ofOutput, model] : models_) {
        if (ofSamples == samples.directions && ofOutput == output) return model;
    }
    models_.push_back({samples.directions, output,
                       priorFor(samples.directions, distinctPairs(pairsOf(output)).distinct,
                                options_.prior, progress, warn)});
    return models_.back().model;
}

}  // namespace abrdf
