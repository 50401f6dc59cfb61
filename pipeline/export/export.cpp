// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export/export.h"

#include "abrdf/output_file.h"
#include "abrdf/sampled_brdf.h"
#include "pipeline/json_text.h"
#include "pipeline/reconstruction.h"
#include "stages/slice/slice_texels.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// A table's values in the exports' colours.
class ConvertedBrdf : public BrdfTable {
  public:
    ConvertedBrdf(const BrdfTable& table, ColorTransform transform)
        : table_(table), transform_(std::move(transform)) {}

    Rgb evaluate(const LightAndView& pair) const override {
        Rgb value = table_.evaluate(pair);
        if (isFinite(value)) transform_.apply({&value, 1});
        return value;
    }
    std::vector<Radians> viewElevations() const override { return table_.viewElevations(); }

  private:
    const BrdfTable& table_;
    ColorTransform transform_;
};

/// The samples of one texel, or of the mean over all.
ImageStack stackOf(const OpenedInput& input, const SampleSet& samples,
                   const std::optional<TexelPlace>& texel, const ProgressSink& progress) {
    if (!texel) return readStack(input, samples, {1, 1}, progress).stack;
    const BtfDescription& description = input.description();
    const auto width = static_cast<std::size_t>(description.width);
    const std::size_t place =
        static_cast<std::size_t>(texel->y) * width + static_cast<std::size_t>(texel->x);
    ImageStack stack(samples.pairs, 1, 1);
    constexpr std::size_t kAtOnce = 8;
    readImages(
        input, samples, {description.width, description.height}, Plane{}, kAtOnce,
        [&](std::size_t image, std::span<const Rgb> texels) {
            stack.image(image)[0] = texels[place];
        },
        progress);
    return stack;
}

void checkTexel(const std::optional<TexelPlace>& texel, const BtfDescription& description) {
    if (!texel || (texel->x < description.width && texel->y < description.height)) return;
    throw std::runtime_error(
        fmt::format("{}: it has {} x {} texels, and none at {},{}; count from "
                    "0,0 at the top left",
                    description.source, description.width, description.height, texel->x, texel->y));
}

/// Fewer than this are no hemisphere: what lies between them would be a guess.
constexpr std::size_t kFewestDirections = 12;

void checkDirections(const BtfDescription& description) {
    const AngularGrid& grid = description.grid;
    const auto fewest = std::min(grid.lights().size(), grid.views().size());
    if (fewest >= kFewestDirections) return;
    throw std::runtime_error(fmt::format(
        "{}: {} lights by {} views are too few for a material: {} of each are needed; convert onto "
        "a grid of more, as --grid ubo81",
        description.source, grid.lights().size(), grid.views().size(), kFewestDirections));
}

/// What was measured, at any pair within the measured elevations, in linear Rec.709.
std::unique_ptr<const BrdfTable> measuredBrdf(const OpenedInput& input,
                                              const std::optional<TexelPlace>& texel,
                                              const ProgressSink& progress) {
    constexpr const char* kSpace = "Linear Rec.709 (sRGB)";
    if (const BrdfTable* table = input.reader->table()) {
        return std::make_unique<ConvertedBrdf>(*table,
                                               input.colors.transform(input.inputSpace, kSpace));
    }
    const AngularGrid& grid = input.description().grid;
    MethodChoice everything;
    everything.name = "measured";
    const PlannedMethod planned = planMethod(everything, input, grid, progress);
    const ImageStack stack = stackOf(input, planned.samples, texel, progress);
    const SlicedTexels sliced = sliceTexels(stack, planned.samples, 0, 1);
    std::vector<Rgb> values(sliced.samples[0].begin(), sliced.samples[0].end());
    input.colors.transform("scene_linear", kSpace).apply(values);
    return std::make_unique<SampledBrdf>(grid, std::move(values));
}

}  // namespace

TexelPlace texelPlaceFromName(const std::string& name) {
    TexelPlace place;
    char comma = 0;
    std::istringstream stream(name);
    if (!(stream >> place.x >> comma >> place.y) || comma != ',' || place.x < 0 || place.y < 0 ||
        stream.peek() != std::char_traits<char>::eof()) {
        throw std::invalid_argument(
            fmt::format("'{}' is no texel: it is X,Y from the top left, as 12,40", name));
    }
    return place;
}

ordered_json exportBrdf(const ExportJob& job, const ProgressSink& progress) {
    const ExportFormat& format = exportFormatFromName(job.format);
    checkOutputPath(job.output);
    const OpenedInput input = openInput(job.input);
    if (fs::exists(job.output) && fs::equivalent(job.output, job.input.input)) {
        throw std::runtime_error(
            fmt::format("{}: is the input as well; choose another output", job.output.string()));
    }
    const BtfDescription& description = input.description();
    checkTexel(job.texel, description);
    if (!input.reader->table()) checkDirections(description);
    const auto measured = measuredBrdf(input, job.texel, progress);
    const GrazingBrdf brdf(*measured, description.maxMeasuredTheta, job.grazing,
                           description.cosine);
    const ExportReport written = format.write(
        job.output, {brdf, description.cosine, description.source, !input.reader->table()},
        job.options);
    ordered_json report;
    report["format"] = format.name;
    report["description"] = format.description;
    report["program"] = "abrdf " ABRDF_VERSION;
    report["source"] = description.source;
    report["source_format"] = description.format;
    if (job.texel) {
        report["texel"] = {job.texel->x, job.texel->y};
    } else {
        report["texels_averaged"] = {description.width, description.height};
    }
    report["color_space"] = "Linear Rec.709 (sRGB)";
    report["cosine_of_source"] = nameOf(description.cosine);
    report["max_measured_theta"] = degreesFromRadians(description.maxMeasuredTheta);
    report["extrapolated"] = {
        {"values", written.extrapolated}, {"of", written.values}, {"grazing", nameOf(job.grazing)}};
    for (const auto& [key, value] : written.details.items()) report[key] = value;
    writeWholeFile(job.output.string() + ".json", jsonText(report, 2) + "\n");
    return report;
}

}  // namespace abrdf
