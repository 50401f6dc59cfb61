// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/scene_pairs.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/evaluate/evaluate_report.h"
#include "pipeline/evaluate/evaluate_sheet.h"
#include "pipeline/evaluate/evaluated_method.h"
#include "pipeline/evaluate/reference.h"
#include "stages/measure/contact_sheet.h"
#include "stages/measure/measures.h"

#include <numeric>
#include <optional>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

/// Beside the estimate: the share of texels whose true error is within it.
void addObeyed(const EvaluatedMethod& reconstruction, const Reference& reference,
               const std::vector<std::uint8_t>& mask, double exposure, ordered_json& result) {
    addEstimate(reconstruction.estimates, result);
    if (!result.contains("estimate")) return;
    std::vector<std::uint8_t> obeys(reconstruction.estimates.size());
    forEachTexelBlock(obeys.size(), 1, [&](std::size_t t, std::size_t) {
        const std::vector<float> errors =
            deltaEMap(reference.truth[t], reconstruction.abrdfs[t], exposure);
        double sum = 0;
        double weight = 0;
        const std::vector<double>& weights = reconstruction.planned.weights;
        for (std::size_t pair = 0; pair < errors.size(); ++pair) {
            if (mask[pair] == 0 || !isFinite(reference.truth[t][pair])) continue;
            const double own = weights.empty() ? 1 : weights[pair];
            sum += own * static_cast<double>(errors[pair]);
            weight += own;
        }
        const double mean = weight > 0 ? sum / weight : 0;
        obeys[t] = mean <= static_cast<double>(reconstruction.estimates[t]) ? 1 : 0;
    });
    result["estimate"]["obeyed"] =
        static_cast<double>(std::accumulate(obeys.begin(), obeys.end(), std::size_t{0})) /
        static_cast<double>(obeys.size());
}

ordered_json measured(const EvaluatedMethod& reconstruction, const Reference& reference,
                      const OpenedInput& input, Texels texels, const EvaluateOptions& options) {
    const PlannedMethod& planned = reconstruction.planned;
    const SampleSet& samples = planned.samples;
    // A table's samples lie off its grid.
    const bool isOffGrid =
        input.reader->table() != nullptr && planned.method->wish != SampleWish::kEverything;
    const std::vector<std::vector<std::uint8_t>> masks = {
        reference.maskWithout({}),
        reference.maskWithout(isOffGrid ? std::vector<std::size_t>{} : samples.pairs)};
    const std::vector<TexelMeasures> measures =
        measureTexels(reference.truth, reconstruction.abrdfs, masks,
                      MeasureOptions{options.exposure, reconstruction.planned.weights});
    std::vector<ordered_json> json;
    for (std::size_t m = 0; m < masks.size(); ++m) {
        json.push_back(jsonOf(measures[m].accuracy));
        if (texels.width * texels.height == 1) continue;
        const SeenOptions seen{.exposure = options.exposure,
                               .isPeriodic = reconstruction.found.plane.edges == Edges::kPeriodic};
        json.back()["texels"] =
            jsonOf(measures[m], measureSeenImages(reference.truth, reconstruction.abrdfs,
                                                  texels.width, texels.height, masks[m], seen));
    }
    ordered_json result;
    result["method"] = planned.method->name;
    result["plan"] = planned.planName();
    result["samples"] = samples.count();
    result["images_read"] = samples.pairs.size();
    result.update(json[0]);
    result["unsampled"] = json[1];
    if (!options.plane.unshift || reconstruction.found.plane.height == 0) {
        addObeyed(reconstruction, reference, masks[0], options.exposure, result);
    }
    result["plane"] = jsonOf(reconstruction.found, input.description().grid);
    result["microseconds_per_abrdf"] = reconstruction.microsecondsPerAbrdf;
    result["multiply_adds"] = reconstruction.multiplyAdds;
    if (!reconstruction.remark.empty()) result["remark"] = reconstruction.remark;
    return result;
}

/// What a scene asks of the measured pairs: its own directions have no truth.
std::optional<SceneChoice> sceneOf(const EvaluateOptions& options, const AngularGrid& grid) {
    if (options.pairs.empty()) return {};
    const ScenePairs scene = scenePairsFromCsv(options.pairs);
    return SceneChoice{{scene.name, sceneWeights(scene, grid)}, options.choice.plan.isOpen()};
}

}  // namespace

std::vector<LightAndView> defaultImagePairs() {
    const auto direction = [](double theta, double phi) {
        return Direction{radiansFromDegrees(theta), radiansFromDegrees(phi)};
    };
    return {{direction(30, 90), direction(0, 0)},
            {direction(45, 0), direction(45, 160)},
            {direction(30, 210), direction(75, 30)}};
}

ordered_json evaluate(const EvaluateOptions& options, const ProgressSink& progress) {
    if (!(options.exposure > 0)) throw std::invalid_argument("the exposure must be above 0");
    for (const std::string& method : options.methods) {
        checkPlanChoice(methodFromName(method), options.choice.plan);
    }
    if (!options.sheet.empty()) checkOutputPath(options.sheet);

    const OpenedInput input = openInput(options.input);
    const AngularGrid& grid = input.description().grid;
    const Texels texels = resolvedTexels(options.texels, input.description());
    const std::optional<SceneChoice> scene = sceneOf(options, grid);
    Reference reference;
    ContactSheet sheet;
    sheet.title = input.description().source;
    sheet.lights = grid.lights().size();
    sheet.views = grid.views().size();
    sheet.exposure = options.exposure;
    sheet.imageWidth = texels.width;
    sheet.imageHeight = texels.height;

    ordered_json report;
    report["command"] = "evaluate";
    report["version"] = ABRDF_VERSION;
    report["input"] = input.description().source;
    report["pairs"] = grid.pairCount();
    report["texels"] = {texels.width, texels.height};
    report["exposure"] = options.exposure;
    if (scene) report["scene"] = options.pairs.filename().string();
    report["results"] = ordered_json::array();
    for (const std::string& method : options.methods) {
        MethodChoice choice = options.choice;
        choice.name = method;
        choice.options.exposure = options.exposure;
        const EvaluatedMethod reconstruction =
            runMethod(choice, input, texels, options.plane, scene ? &*scene : nullptr, progress);
        // Results are compared in the frame that they are in.
        const Plane frame = options.plane.unshift ? Plane{} : reconstruction.found.plane;
        if (reference.truth.texelCount() == 0 || reference.plane.height != frame.height) {
            reference = {};  // Its memory first.
            reference = readReference(input, texels, frame, progress);
            if (sheet.measurement.empty()) sheet.measurement = meanAbrdf(reference.truth);
        }
        report["results"].push_back(measured(reconstruction, reference, input, texels, options));
        sheet.rows.push_back(sheetRowOf(report["results"].back(), reconstruction.abrdfs));
        if (options.sheet.empty() || reference.truth.texelCount() == 1) continue;
        sheet.rows.back().images = sheetImages(reference, reconstruction, grid, options.imagePairs);
    }
    if (!options.sheet.empty()) writeContactSheet(options.sheet, sheet);
    return report;
}

}  // namespace abrdf
