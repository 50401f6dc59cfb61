// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
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
    ImageStack stack;
    std::vector<Rgb> imageMeans;
    AbrdfTile truth;                    ///< All texels, linear Rec.709.
    std::vector<std::uint8_t> present;  ///< One flag a pair.
    ColorTransform toRec709;
};

Reference readReference(const OpenedInput& input, const EvaluateOptions& options,
                        const ProgressSink& progress) {
    const BtfDescription& description = input.description();
    const Texels texels = resolvedTexels(options.texels, description);
    const SampleSet everything =
        samplesFor(methodFromName("measured"), {}, input, description.grid);
    ReadStack read = readStack(input, everything, texels, progress);
    Reference reference{std::move(read.stack),
                        std::move(read.facts.means),
                        {},
                        description.present,
                        input.colors.transform("scene_linear", "Linear Rec.709 (sRGB)")};
    reference.truth =
        sliceTexels(reference.stack, everything, 0, reference.stack.texelCount()).samples;
    forEachTexelBlock(reference.truth.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        reference.toRec709.apply(reference.truth[texel]);
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
    const float share = 1.0F / static_cast<float>(tile.texelCount());
    for (std::size_t t = 0; t < tile.texelCount(); ++t) {
        for (std::size_t pair = 0; pair < mean.size(); ++pair) mean[pair] += share * tile[t][pair];
    }
    return mean;
}

ordered_json evaluateMethod(const std::string& name, const OpenedInput& input,
                            const Reference& reference, const EvaluateOptions& options,
                            ContactSheet& sheet, const ProgressSink& progress) {
    const AngularGrid& grid = input.description().grid;
    MethodChoice choice = options.choice;
    choice.name = name;
    choice.options.exposure = options.exposure;
    const PlannedMethod planned = planMethod(choice, input, grid, progress);
    const Method& method = *planned.method;
    const SampleSet& samples = planned.samples;
    // A table's samples lie off its grid; images are those of the reference.
    const bool isTable = input.reader->table() != nullptr;
    const ReadStack own = isTable ? readStack(input, samples, {1, 1}, {}) : ReadStack{};
    const ImageStack& stack = isTable ? own.stack : reference.stack;
    const auto sampledOnGrid = isTable && method.wish != SampleWish::kEverything
                                   ? std::vector<std::size_t>{}
                                   : samples.pairs;
    const auto reconstructor =
        buildReconstructor(choice, planned, input, stack.pairs(),
                           isTable ? own.facts.means : reference.imageMeans, progress);
    const SlicedTexels sliced = sliceTexels(stack, samples, 0, stack.texelCount());
    AbrdfTile abrdfs = reconstructTexels(sliced.samples, grid, *reconstructor).abrdfs;
    forEachTexelBlock(abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        reference.toRec709.apply(abrdfs[texel]);
    });
    const MeasureOptions measure{options.exposure};
    const auto accuracy = [&](const std::vector<std::size_t>& excluded) {
        return measureAccuracy(reference.truth.values(), abrdfs.values(),
                               maskOf(reference, excluded), measure);
    };
    ordered_json result;
    result["method"] = name;
    result["plan"] = planned.planName();
    result["samples"] = samples.count();
    result["images_read"] = samples.pairs.size();
    result.update(jsonOf(accuracy({})));
    result["unsampled"] = jsonOf(accuracy(sampledOnGrid));
    result["microseconds_per_abrdf"] =
        microsecondsPerAbrdf(*reconstructor, sliced.samples, grid.pairCount());
    result["multiply_adds"] = reconstructor->multiplyAdds();
    sheet.rows.push_back(
        {fmt::format("{}, plan {}, {} samples", name, result["plan"].get<std::string>(),
                     samples.count()),
         fmt::format("Delta E {:.2f}   PSNR {:.1f} dB   {} images", result["delta_e"].get<double>(),
                     result["psnr"].get<double>(), samples.pairs.size()),
         meanAbrdf(abrdfs)});
    return result;
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
    const Reference reference = readReference(input, options, progress);
    ContactSheet sheet;
    sheet.title = input.description().source;
    sheet.lights = grid.lights().size();
    sheet.views = grid.views().size();
    sheet.exposure = options.exposure;
    sheet.measurement = meanAbrdf(reference.truth);

    ordered_json report;
    report["command"] = "evaluate";
    report["version"] = ABRDF_VERSION;
    report["input"] = input.description().source;
    report["pairs"] = grid.pairCount();
    report["texels"] = {reference.stack.width(), reference.stack.height()};
    report["exposure"] = options.exposure;
    report["results"] = ordered_json::array();
    for (const std::string& method : options.methods) {
        report["results"].push_back(
            evaluateMethod(method, input, reference, options, sheet, progress));
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
