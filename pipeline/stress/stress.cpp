// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/pair_features.h"
#include "pipeline/input_samples.h"
#include "pipeline/json_text.h"
#include "pipeline/stress/stress_trial.h"
#include "stages/measure/conditioning_figure.h"
#include "stages/measure/gnuplot.h"
#include "stages/measure/stress_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

/// The average of a database as a material: exact at its pairs, interpolated between them.
StressMaterial measuredMaterial(const fs::path& path, const StressOptions& options,
                                const ProgressSink& progress, const MessageSink& warn) {
    InputOptions inputOptions;
    inputOptions.input = path;
    inputOptions.colorConfig = options.colorConfig;
    inputOptions.warn = warn;
    const OpenedInput input = openInput(inputOptions);
    const AngularGrid grid = input.description().grid;
    const SampleSet everything = samplesFor(methodFromName("measured"), {}, input, grid);
    const ReadStack read = readStack(input, everything, {1, 1}, {}, progress);
    auto values = std::make_shared<std::vector<Rgb>>(
        meanSamples(read.stack.pairs(), read.facts.means, everything));
    input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)").apply(*values);
    for (Rgb& c : *values) c = {std::max(c.r, 0.0F), std::max(c.g, 0.0F), std::max(c.b, 0.0F)};
    auto between = std::make_shared<const PairInterpolation>(grid);
    return {path.filename().string(), [values, between](const LightAndView& pair) {
                Rgb sum;
                for (const WeightedPair& term : between->weights(pair)) {
                    sum += term.weight * (*values)[term.pair];
                }
                return sum;
            }};
}

std::vector<StressCase> chosenCases(const StressOptions& options) {
    std::vector<StressCase> all = stressCases();
    std::vector<StressCase> chosen;
    for (const std::string& name : options.cases) {
        const auto found = std::ranges::find(all, name, &StressCase::name);
        if (found == all.end()) {
            std::string names;
            for (const StressCase& c : all) names += " " + c.name;
            throw std::invalid_argument(
                fmt::format("there is no case '{}'; the cases are:{}", name, names));
        }
        chosen.push_back(*found);
    }
    if (!options.cases.empty()) return chosen;
    if (options.inputs.empty()) return all;
    std::erase_if(all, [](const StressCase& c) { return !c.ofAnyMaterial; });
    return all;
}

std::vector<StressMethod> chosenMethods(const StressOptions& options, const AngularGrid& grid,
                                        const ProgressSink& progress, const MessageSink& warn) {
    std::vector<std::string> names = options.methods;
    if (names.empty()) {
        for (const Method& method : methods()) {
            if (method.wish != SampleWish::kEverything) names.emplace_back(method.name);
        }
    }
    std::vector<StressMethod> chosen;
    for (const std::string& name : names) {
        const Method& method = methodFromName(name);
        if (method.wish == SampleWish::kEverything) {
            throw std::invalid_argument(
                fmt::format("the method {} reconstructs nothing, so nothing can fail it", name));
        }
        const bool ownPlan = method.wish == SampleWish::kSlices;
        chosen.push_back({&method, planFor(method, ownPlan ? PlanChoice{} : options.plan, grid, {},
                                           false, progress, warn)});
    }
    return chosen;
}

/// One case on all materials: outcomes [step][material][method].
class CaseRun {
  public:
    CaseRun(const StressCase& stressCase, const std::vector<StressMaterial>& materials,
            const std::vector<StressMethod>& methods, const AngularGrid& grid,
            const StressOptions& options)
        : case_(stressCase),
          materials_(materials),
          methods_(methods),
          grid_(grid),
          options_(options) {}

    void run(const ProgressSink& progress, const MessageSink& warn) {
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

    ordered_json resultOf(std::size_t method) const;

  private:
    std::uint64_t hashOfName() const {
        std::uint64_t hash = 0;
        for (const char c : case_.name) hash = hashOf({hash, static_cast<std::uint64_t>(c)});
        return hash;
    }

    std::shared_ptr<const PriorModel> modelOf(const SampleSet& samples, const AngularGrid& output,
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

    struct KeptModel {
        std::vector<LightAndView> samples;
        AngularGrid output;
        std::shared_ptr<const PriorModel> model;
    };

    const StressCase& case_;
    const std::vector<StressMaterial>& materials_;
    const std::vector<StressMethod>& methods_;
    const AngularGrid& grid_;
    const StressOptions& options_;
    std::vector<KeptModel> models_;
    std::vector<StressOutcome> outcomes_;
};

ordered_json CaseRun::resultOf(std::size_t method) const {
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

StressFigure figureOf(const StressCase& stressCase, const std::vector<ordered_json>& results) {
    StressFigure figure;
    figure.title = fmt::format("{}: {}", stressCase.name, stressCase.title);
    figure.axis = stressCase.axis;
    figure.kindsOnly = stressCase.kindsOnly;
    for (const StressStep& step : stressCase.steps) figure.labels.push_back(step.label);
    for (const ordered_json& result : results) {
        StressCurve curve{result["method"], {}, {}};
        for (const ordered_json& step : result["steps"]) {
            curve.errors.push_back(step["delta_e"].is_null()
                                       ? std::numeric_limits<double>::quiet_NaN()
                                       : step["delta_e"].get<double>());
        }
        curve.breakdown = breakdownStep(curve.errors);
        figure.curves.push_back(std::move(curve));
    }
    return figure;
}

std::vector<ConditioningCurve> conditioningCurves(const std::vector<ordered_json>& results) {
    std::vector<ConditioningCurve> curves;
    for (const ordered_json& result : results) {
        ConditioningCurve curve{result["method"], {}};
        for (const ordered_json& step : result["steps"]) {
            if (step.contains("twin_delta_e")) {
                curve.points.push_back({step["condition"], step["twin_delta_e"]});
            }
        }
        std::ranges::stable_sort(curve.points, {}, &ConditioningCurve::Point::condition);
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace

ordered_json stress(const StressOptions& options, const ProgressSink& progress,
                    const MessageSink& warn) {
    const std::vector<StressCase> cases = chosenCases(options);
    const AngularGrid grid = gridFromName(options.grid);
    const std::vector<StressMethod> methods = chosenMethods(options, grid, progress, warn);
    std::vector<StressMaterial> materials;
    for (const fs::path& input : options.inputs) {
        materials.push_back(measuredMaterial(input, options, progress, warn));
    }
    if (materials.empty()) materials = stressMaterials();
    const std::vector<StressMaterial> none(1);
    fs::create_directories(options.output);

    ordered_json report = {{"command", "stress"}, {"version", ABRDF_VERSION}};
    report["materials"] = ordered_json::array();
    for (const StressMaterial& material : materials) report["materials"].push_back(material.name);
    report["seed"] = options.seed;
    report["results"] = ordered_json::array();
    for (const StressCase& stressCase : cases) {
        CaseRun run(stressCase, stressCase.ofAnyMaterial ? materials : none, methods, grid,
                    options);
        run.run(progress, warn);
        std::vector<ordered_json> results;
        for (std::size_t m = 0; m < methods.size(); ++m) results.push_back(run.resultOf(m));
        const StressFigure figure = figureOf(stressCase, results);
        const fs::path base = options.output / stressCase.name;
        runGnuplot(stressFigureScript(figure, false), fs::path(base) += ".svg");
        runGnuplot(stressFigureScript(figure, true), fs::path(base) += ".png");
        if (const auto curves = conditioningCurves(results); !curves.empty()) {
            const std::string title = stressCase.name + ": what rounding does to an answer";
            const fs::path twins = options.output / (stressCase.name + "-twin");
            runGnuplot(conditioningFigureScript(title, curves, false), fs::path(twins) += ".svg");
            runGnuplot(conditioningFigureScript(title, curves, true), fs::path(twins) += ".png");
        }
        for (ordered_json& result : results) report["results"].push_back(std::move(result));
    }
    writeWholeFile(options.output / "stress.json", jsonText(report, 2) + "\n");
    return report;
}

std::string breakdownTable(const ordered_json& report) {
    std::vector<std::string> methods;
    std::vector<std::string> cases;
    std::map<std::pair<std::string, std::string>, std::string> cells;
    const auto addOnce = [](std::vector<std::string>& list, const std::string& name) {
        if (std::ranges::find(list, name) == list.end()) list.push_back(name);
    };
    for (const ordered_json& result : report["results"]) {
        addOnce(methods, result["method"]);
        addOnce(cases, result["case"]);
        cells[{result["case"], result["method"]}] = result["breakdown"];
    }
    std::string table = fmt::format("{:<18}", "breaks down at");
    for (const std::string& method : methods) table += fmt::format("{:>13}", method);
    for (const std::string& name : cases) {
        table += fmt::format("\n{:<18}", name);
        for (const std::string& method : methods) {
            table += fmt::format("{:>13}", cells[{name, method}].substr(0, 12));
        }
    }
    return table + "\n";
}

}  // namespace abrdf
