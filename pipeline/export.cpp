// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export.h"

#include "abrdf/output_file.h"
#include "abrdf/sampled_brdf.h"
#include "pipeline/json_text.h"
#include "pipeline/reconstruction.h"
#include "stages/slice/slice_texels.h"

#include <fmt/format.h>

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

  private:
    const BrdfTable& table_;
    ColorTransform transform_;
};

/// What was measured, at any pair within the measured elevations, in linear Rec.709.
std::unique_ptr<const BrdfTable> measuredBrdf(const OpenedInput& input,
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
    const ReadStack read = readStack(input, planned.samples, {1, 1}, progress);
    const SlicedTexels sliced = sliceTexels(read.stack, planned.samples, 0, 1);
    std::vector<Rgb> values(sliced.samples[0].begin(), sliced.samples[0].end());
    input.colors.transform("scene_linear", kSpace).apply(values);
    return std::make_unique<SampledBrdf>(grid, std::move(values));
}

}  // namespace

ordered_json exportBrdf(const ExportJob& job, const ProgressSink& progress) {
    const ExportFormat& format = exportFormatFromName(job.format);
    checkOutputPath(job.output);
    const OpenedInput input = openInput(job.input);
    if (fs::exists(job.output) && fs::equivalent(job.output, job.input.input)) {
        throw std::runtime_error(
            fmt::format("{}: is the input as well; choose another output", job.output.string()));
    }
    const BtfDescription& description = input.description();
    const auto measured = measuredBrdf(input, progress);
    const GrazingBrdf brdf(*measured, description.maxMeasuredTheta, job.grazing,
                           description.cosine);
    const ExportReport written =
        format.write(job.output, {brdf, description.cosine, description.source}, job.options);
    ordered_json report;
    report["format"] = format.name;
    report["description"] = format.description;
    report["program"] = "abrdf " ABRDF_VERSION;
    report["source"] = description.source;
    report["source_format"] = description.format;
    report["texels_averaged"] = {description.width, description.height};
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
