// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/scene_pairs.h"
#include "pipeline/chart/method_time.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/convert/unshifted_texels.h"
#include "pipeline/evaluate/evaluate_report.h"
#include "pipeline/evaluate/evaluate_sheet.h"
#include "pipeline/input_samples.h"
#include "pipeline/named_pair.h"
#include "stages/measure/contact_sheet.h"
#include "stages/measure/measures.h"
#include "stages/slice/choose_samples.h"
#include "stages/slice/slice_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

/// The full measurement, and what is needed to compare with it.
struct Reference {
    AbrdfTile truth;  ///< All texels, linear Rec.709; NaN where a shifted image has nothing.
    Plane plane;      ///< That its images are shifted to.
    std::vector<std::uint8_t> present;  ///< One flag a pair.
    ColorTransform toRec709;
};

Reference readReference(const OpenedInput& input, Texels texels, const Plane& plane,
                        const ProgressSink& progress) {
    const BtfDescription& description = input.description();
    const SampleSet everything =
        samplesFor(methodFromName("measured"), {}, input, description.grid);
    const ImageStack stack = readStack(input, everything, texels, plane, progress).stack;
    Reference reference{sliceTexels(stack, everything, 0, stack.texelCount()).samples, plane,
                        description.present,
                        input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)")};
    forEachTexelBlock(reference.truth.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        reference.toRec709.apply(reference.truth[texel]);
        // What has no measurement is not compared, whatever filled it.
        for (std::size_t i = 0; plane.height != 0 && i < stack.pairs().size(); ++i) {
            const Rgb measured = stack.image(i)[texel];
            if (!isFinite(measured)) reference.truth[texel][stack.pairs()[i]] = measured;
        }
    });
    return reference;
}

/// Flags of the pairs to compare: measured ones, without `excluded`.
std::vector<std::uint8_t> maskOf(const Reference& reference,
                                 const std::vector<std::size_t>& excluded) {
    std::vector<std::uint8_t> pairs = reference.present;
    for (const std::size_t pair : excluded) pairs[pair] = 0;
    return pairs;
}

/// What a method makes of one input.
struct Reconstruction {
    PlannedMethod planned;
    FoundPlane found;
    AbrdfTile abrdfs;              ///< Linear Rec.709.
    std::vector<float> estimates;  ///< A bound of each texel's Delta E; may be empty.
    double microsecondsPerAbrdf = 0;
    double multiplyAdds = 0;
    std::string remark;  ///< As Reconstructor's.
};

Reconstruction reconstruct(const MethodChoice& choice, const OpenedInput& input, Texels texels,
                           const PlaneChoice& plane, const SceneChoice* scene,
                           const ProgressSink& progress) {
    const AngularGrid& grid = input.description().grid;
    Reconstruction result;
    result.planned = planMethod(choice, input, grid, progress, scene);
    const SampleSet& samples = result.planned.samples;
    result.found = planeOf(result.planned, plane, input, texels, progress);
    const ReadStack read = readStack(input, samples, texels, result.found.plane, progress);
    const ImageStack& stack = read.stack;
    const auto reconstructor =
        buildReconstructor(choice, result.planned, input, stack.pairs(), read.facts, progress);
    const SlicedTexels sliced = sliceTexels(stack, samples, 0, stack.texelCount());
    const auto all = [&](int, int) {
        return reconstructTexels(sliced.samples, grid, *reconstructor);
    };
    ReconstructedTexels made =
        plane.unshift && result.found.plane.height != 0
            ? UnshiftedTexels(result.found.plane, input.description(), texels, grid, all)
                  .rows(0, texels.height)
            : all(0, texels.height);
    result.abrdfs = std::move(made.abrdfs);
    result.estimates = std::move(made.estimates);
    const ColorTransform toRec709 = input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)");
    forEachTexelBlock(result.abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        toRec709.apply(result.abrdfs[texel]);
    });
    result.microsecondsPerAbrdf =
        timeMethod(*reconstructor, sliced.samples[0], grid.pairCount(), 0.05).oneCore;
    result.multiplyAdds = reconstructor->multiplyAdds();
    result.remark = reconstructor->remark();
    return result;
}

/// Beside the estimate: the share of texels whose true error is within it.
void addObeyed(const Reconstruction& reconstruction, const Reference& reference,
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

ordered_json measured(const Reconstruction& reconstruction, const Reference& reference,
                      const OpenedInput& input, Texels texels, const EvaluateOptions& options) {
    const PlannedMethod& planned = reconstruction.planned;
    const SampleSet& samples = planned.samples;
    // A table's samples lie off its grid.
    const bool isOffGrid =
        input.reader->table() != nullptr && planned.method->wish != SampleWish::kEverything;
    const std::vector<std::vector<std::uint8_t>> masks = {
        maskOf(reference, {}),
        maskOf(reference, isOffGrid ? std::vector<std::size_t>{} : samples.pairs)};
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

/// Measurement and reconstruction at the measured pairs nearest to those that were asked for.
std::vector<SheetImage> sheetImages(const Reconstruction& reconstruction,
                                    const Reference& reference, const AngularGrid& grid,
                                    const std::vector<LightAndView>& wanted) {
    const std::vector<std::size_t>& sampled = reconstruction.planned.samples.pairs;
    std::vector<SheetImage> images;
    for (const LightAndView& place : wanted) {
        std::size_t best = 0;
        for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
            if (reference.present[pair] != 0 &&
                squaredDistance(grid.pair(pair), place) < squaredDistance(grid.pair(best), place)) {
                best = pair;
            }
        }
        const bool isSampled = std::ranges::binary_search(sampled, best);
        images.push_back({fmt::format("{}, {}", pairName(grid.pair(best)),
                                      isSampled ? "a sample" : "not sampled"),
                          imageOf(reference.truth, best), imageOf(reconstruction.abrdfs, best)});
    }
    return images;
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
        const Reconstruction reconstruction =
            reconstruct(choice, input, texels, options.plane, scene ? &*scene : nullptr, progress);
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
        sheet.rows.back().images = sheetImages(reconstruction, reference, grid, options.imagePairs);
    }
    if (!options.sheet.empty()) writeContactSheet(options.sheet, sheet);
    return report;
}

}  // namespace abrdf
