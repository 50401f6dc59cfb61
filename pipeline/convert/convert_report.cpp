// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert_report.h"

#include "pipeline/convert/estimate_report.h"
#include "pipeline/plan/plan_advice.h"
#include "pipeline/process_memory.h"

#include <algorithm>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

/// What the scene shows, and what that saved beside the same conversion of all pairs.
ordered_json sceneReport(const ConvertJob& job, const ConvertOptions& options) {
    const AngularGrid whole =
        options.grid == "input" ? job.input.description().grid : gridFromName(options.grid);
    const bool readsAll = job.planned.method->wish == SampleWish::kEverything;
    const std::size_t images =
        readsAll ? job.input.description().imageCount()
                 : std::min(kPlanSamples, job.input.description().grid.pairCount());
    ordered_json report = {
        {"file", options.pairs.filename().string()},
        {"pairs", job.scene->pairs.size()},
        {"own_directions",
         {{"lights", job.grid.lights() != whole.lights()},
          {"views", job.grid.views() != whole.views()}}},
        {"images", {{"read", job.samples().pairs.size()}, {"without", images}}},
        {"outputs", {{"reconstructed", job.grid.pairCount()}, {"without", whole.pairCount()}}}};
    if (job.planned.expectedError) report["expected_delta_e"] = *job.planned.expectedError;
    return report;
}

ordered_json countsOf(const ValueCounts& counts, std::uint64_t dimmed) {
    return {{"clamped", counts.clamped},     {"extrapolated", counts.extrapolated},
            {"nonfinite", counts.nonfinite}, {"missing", counts.missing},
            {"outside", counts.outside},     {"dimmed", dimmed}};
}

}  // namespace

ordered_json reportOf(const ConvertJob& job, const ConvertOptions& options) {
    const BtfDescription& description = job.input.description();
    ordered_json report;
    report["command"] = "convert";
    report["version"] = ABRDF_VERSION;
    report["input"] = {{"format", description.format},
                       {"lights", description.grid.lights().size()},
                       {"views", description.grid.views().size()},
                       {"width", description.width},
                       {"height", description.height},
                       {"images", description.imageCount()},
                       {"below_horizon", description.belowHorizon},
                       {"cosine", nameOf(description.cosine)},
                       {"color_space", job.input.inputSpace}};
    report["plan"] = {{"name", job.header.plan},
                      {"samples", job.samples().count()},
                      {"images_read", job.samples().pairs.size()}};
    report["method"] = job.method.name;
    if (job.planned.method->needsPrior) {
        const std::string advice = planAdvice(job.header.plan, job.samples().count());
        if (!advice.empty()) report["advice"] = advice;
    }
    if (!job.chosen.is_null()) report["choice"] = job.chosen;
    report["texels"] = {job.texels.width, job.texels.height};
    const ordered_json conversion = {{"what", description.source},
                                     {"from", job.input.inputSpace},
                                     {"to", job.header.colorSpace}};
    report["color"] = {{"config", job.input.colors.origin()},
                       {"conversions", ordered_json::array({conversion})}};
    report["grid"] = {{"lights", job.grid.lights().size()}, {"views", job.grid.views().size()}};
    if (job.scene) report["scene"] = sceneReport(job, options);
    report["grazing"] = nameOf(options.grazing);
    report["plane"] = jsonOf(job.found, description.grid);
    if (job.header.shard > 0) report["shard"] = {job.header.shard, job.header.shards};
    return report;
}

ordered_json reportOf(const ConvertJob& job, const ConvertOptions& options,
                      const MemoryPlan& memory, const WrittenAtlas& written,
                      const std::string& remark, RunSeconds seconds) {
    ordered_json report = reportOf(job, options);
    report["counts"] = countsOf(written.counts, written.dimmed);
    addEstimate(written.estimates, report);
    if (!remark.empty()) report["remark"] = remark;
    // Tiles are made while others are written: what remains beside reading and writing.
    report["time"] = {
        {"plan", job.planSeconds},
        {"read", seconds.read - job.found.seconds - job.planSeconds},
        {"align", job.found.seconds},
        {"reconstruct", std::max(0.0, seconds.total - seconds.read - written.writeSeconds)},
        {"write", written.writeSeconds},
        {"total", seconds.total}};
    report["peak_memory"] = peakMemory();
    report["scratch_bytes"] = memory.scratchBytes;
    if (written.resumedTiles > 0) report["resumed_tiles"] = written.resumedTiles;
    report["output"] = {{"path", options.output.string()},
                        {"bytes", written.bytes},
                        {"pixel", nameOf(written.type)}};
    return report;
}

}  // namespace abrdf
