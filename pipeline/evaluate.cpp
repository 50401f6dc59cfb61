// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "pipeline/unshifted_texels.h"
#include "stages/measure/contact_sheet.h"
#include "stages/measure/measures.h"
#include "stages/slice/choose_samples.h"
#include "stages/slice/slice_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
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

/// Flags of the pairs to compare, repeated for each texel: measured ones, without `excluded`.
std::vector<std::uint8_t> maskOf(const Reference& reference,
                                 const std::vector<std::size_t>& excluded) {
    std::vector<std::uint8_t> pairs = reference.present;
    for (const std::size_t pair : excluded) pairs[pair] = 0;
    std::vector<std::uint8_t> mask;
    for (std::size_t t = 0; t < reference.truth.texelCount(); ++t) {
        mask.insert(mask.end(), pairs.begin(), pairs.end());
    }
    return mask;
}

/// Median of warm repetitions on one core, in microseconds: of as many texels as the method likes
/// to do together, or as there are.
double microsecondsPerAbrdf(const Reconstructor& reconstructor, const AbrdfTile& samples,
                            std::size_t pairs) {
    using Clock = std::chrono::steady_clock;
    const std::size_t texels = std::min(reconstructor.texelsAtOnce(), samples.texelCount());
    std::vector<Rgb> abrdfs(pairs * texels);
    std::vector<double> times;
    const auto start = Clock::now();
    while (times.size() < 5 ||
           (Clock::now() - start < std::chrono::milliseconds(50) && times.size() < 1000)) {
        const auto before = Clock::now();
        reconstructor.reconstruct(samples.values().first(samples.valuesPerTexel() * texels),
                                  abrdfs);
        times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - before).count() /
                        static_cast<double>(texels));
    }
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    return times[times.size() / 2];
}

ordered_json jsonOf(const Measures& m) {
    return {
        {"delta_e", m.deltaE}, {"delta_e_2000", m.deltaE2000}, {"rmse", m.rmse}, {"psnr", m.psnr}};
}

ordered_json jsonOf(const Accuracy& accuracy) {
    ordered_json json = jsonOf(accuracy.natural);
    json["stops"] = accuracy.stops;
    json["highlight"] = jsonOf(accuracy.highlight);
    json["pairs"] = accuracy.pairs;
    return json;
}

/// Mean over all texels, pair by pair: what the sheet shows.
std::vector<Rgb> meanAbrdf(const AbrdfTile& tile) {
    std::vector<Rgb> mean(tile.valuesPerTexel());
    std::vector<float> counts(mean.size());
    for (std::size_t t = 0; t < tile.texelCount(); ++t) {
        for (std::size_t pair = 0; pair < mean.size(); ++pair) {
            if (!isFinite(tile[t][pair])) continue;
            mean[pair] += tile[t][pair];
            ++counts[pair];
        }
    }
    for (std::size_t pair = 0; pair < mean.size(); ++pair) mean[pair] *= 1 / counts[pair];
    return mean;
}

/// What a method makes of one input.
struct Reconstruction {
    PlannedMethod planned;
    FoundPlane found;
    AbrdfTile abrdfs;  ///< Linear Rec.709.
    double microsecondsPerAbrdf = 0;
    double multiplyAdds = 0;
};

Reconstruction reconstruct(const MethodChoice& choice, const OpenedInput& input, Texels texels,
                           const PlaneChoice& plane, const ProgressSink& progress) {
    const AngularGrid& grid = input.description().grid;
    Reconstruction result;
    result.planned = planMethod(choice, input, grid, progress);
    const SampleSet& samples = result.planned.samples;
    result.found = planeOf(result.planned, plane, input, texels, progress);
    const ImageStack stack = readStack(input, samples, texels, result.found.plane, progress).stack;
    const auto reconstructor = buildReconstructor(choice, result.planned, input, stack, progress);
    const SlicedTexels sliced = sliceTexels(stack, samples, 0, stack.texelCount());
    const auto all = [&](int, int) {
        return reconstructTexels(sliced.samples, grid, *reconstructor);
    };
    result.abrdfs =
        plane.unshift && result.found.plane.height != 0
            ? UnshiftedTexels(result.found.plane, input.description(), texels, grid, all)
                  .rows(0, texels.height)
                  .abrdfs
            : all(0, texels.height).abrdfs;
    const ColorTransform toRec709 =
        input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)");
    forEachTexelBlock(result.abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        toRec709.apply(result.abrdfs[texel]);
    });
    result.microsecondsPerAbrdf =
        microsecondsPerAbrdf(*reconstructor, sliced.samples, grid.pairCount());
    result.multiplyAdds = reconstructor->multiplyAdds();
    return result;
}

ordered_json measured(const Reconstruction& reconstruction, const Reference& reference,
                      const OpenedInput& input, const EvaluateOptions& options) {
    const PlannedMethod& planned = reconstruction.planned;
    const SampleSet& samples = planned.samples;
    // A table's samples lie off its grid.
    const bool isOffGrid =
        input.reader->table() != nullptr && planned.method->wish != SampleWish::kEverything;
    const MeasureOptions measure{options.exposure};
    const auto accuracy = [&](const std::vector<std::size_t>& excluded) {
        return measureAccuracy(reference.truth.values(), reconstruction.abrdfs.values(),
                               maskOf(reference, excluded), measure);
    };
    ordered_json result;
    result["method"] = planned.method->name;
    result["plan"] = planned.planName();
    result["samples"] = samples.count();
    result["images_read"] = samples.pairs.size();
    result.update(jsonOf(accuracy({})));
    result["unsampled"] = jsonOf(accuracy(isOffGrid ? std::vector<std::size_t>{} : samples.pairs));
    result["plane"] = jsonOf(reconstruction.found, input.description().grid);
    result["microseconds_per_abrdf"] = reconstruction.microsecondsPerAbrdf;
    result["multiply_adds"] = reconstruction.multiplyAdds;
    return result;
}

SheetRow sheetRowOf(const ordered_json& result, const AbrdfTile& abrdfs) {
    return {fmt::format("{}, plan {}, {} samples", result["method"].get<std::string>(),
                        result["plan"].get<std::string>(), result["samples"].get<std::size_t>()),
            fmt::format("Delta E {:.2f}   PSNR {:.1f} dB   {} images",
                        result["delta_e"].get<double>(), result["psnr"].get<double>(),
                        result["images_read"].get<std::size_t>()),
            meanAbrdf(abrdfs)};
}

}  // namespace

ordered_json evaluate(const EvaluateOptions& options, const ProgressSink& progress) {
    if (!(options.exposure > 0)) throw std::invalid_argument("the exposure must be above 0");
    for (const std::string& method : options.methods) {
        checkPlanChoice(methodFromName(method), options.choice.plan);
    }
    if (!options.sheet.empty()) checkOutputPath(options.sheet);

    const OpenedInput input = openInput(options.input);
    const AngularGrid& grid = input.description().grid;
    const Texels texels = resolvedTexels(options.texels, input.description());
    Reference reference;
    ContactSheet sheet;
    sheet.title = input.description().source;
    sheet.lights = grid.lights().size();
    sheet.views = grid.views().size();
    sheet.exposure = options.exposure;

    ordered_json report;
    report["command"] = "evaluate";
    report["version"] = ABRDF_VERSION;
    report["input"] = input.description().source;
    report["pairs"] = grid.pairCount();
    report["texels"] = {texels.width, texels.height};
    report["exposure"] = options.exposure;
    report["results"] = ordered_json::array();
    for (const std::string& method : options.methods) {
        MethodChoice choice = options.choice;
        choice.name = method;
        choice.options.exposure = options.exposure;
        const Reconstruction reconstruction =
            reconstruct(choice, input, texels, options.plane, progress);
        // Results are compared in the frame that they are in.
        const Plane frame = options.plane.unshift ? Plane{} : reconstruction.found.plane;
        if (reference.truth.texelCount() == 0 || reference.plane.height != frame.height) {
            reference = {};  // Its memory first.
            reference = readReference(input, texels, frame, progress);
            if (sheet.measurement.empty()) sheet.measurement = meanAbrdf(reference.truth);
        }
        report["results"].push_back(measured(reconstruction, reference, input, options));
        sheet.rows.push_back(sheetRowOf(report["results"].back(), reconstruction.abrdfs));
    }
    if (!options.sheet.empty()) writeContactSheet(options.sheet, sheet);
    return report;
}

std::string tableOf(const ordered_json& report) {
    std::string table = fmt::format("{}: {} pairs\n", report["input"].get<std::string>(),
                                    report["pairs"].get<std::size_t>());
    table += fmt::format("{:<12}{:<9}{:>8}{:>8} |{:>8}{:>8}{:>8}{:>8} |{:>8}{:>8} |{:>7}{:>12}\n",
                         "method", "plan", "samples", "images", "dE76", "dE2000", "RMSE", "PSNR",
                         "hi dE76", "hi PSNR", "stops", "us/ABRDF");
    for (const ordered_json& r : report["results"]) {
        const auto number = [](const ordered_json& from, const char* key) {
            return from[key].get<double>();
        };
        table += fmt::format(
            "{:<12}{:<9}{:>8}{:>8} |{:>8.2f}{:>8.2f}{:>8.2f}{:>8.1f} |{:>8.2f}{:>8.1f} "
            "|{:>7.2f}{:>12.1f}\n",
            r["method"].get<std::string>(), r["plan"].get<std::string>(),
            r["samples"].get<std::size_t>(), r["images_read"].get<std::size_t>(),
            number(r, "delta_e"), number(r, "delta_e_2000"), number(r, "rmse"), number(r, "psnr"),
            number(r["highlight"], "delta_e"), number(r["highlight"], "psnr"), number(r, "stops"),
            number(r, "microseconds_per_abrdf"));
    }
    return table;
}

}  // namespace abrdf
