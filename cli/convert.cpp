// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert.h"

#include "cli/atlas_options.h"
#include "cli/command.h"
#include "pipeline/convert/dry_run.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdint>

namespace abrdf {

namespace {

struct Options {
    ConvertOptions job;
    std::string texels = "1x1";
    PlaneOptions plane;
    AtlasOptions atlas;
    std::string shard = "1/1";
    std::string budget;
    bool dryRun = false;
    bool noClobber = false;
};

std::string summaryOf(const nlohmann::ordered_json& r) {
    const std::string before =
        r.contains("finished_before") ? ", finished by an earlier run"
        : r.contains("resumed_tiles")
            ? fmt::format(", {} tiles from an earlier run", r["resumed_tiles"].get<std::size_t>())
            : "";
    const std::string saved =
        r.contains("scene")
            ? fmt::format(
                  "for the {} pairs of {}: {} images instead of {}, {} "
                  "pairs a texel instead of {}\n",
                  r["scene"]["pairs"].get<std::size_t>(), r["scene"]["file"].get<std::string>(),
                  r["scene"]["images"]["read"].get<std::size_t>(),
                  r["scene"]["images"]["without"].get<std::size_t>(),
                  r["scene"]["outputs"]["reconstructed"].get<std::size_t>(),
                  r["scene"]["outputs"]["without"].get<std::size_t>())
            : "";
    const std::string advice = r.contains("advice") ? r["advice"].get<std::string>() + "\n" : "";
    return fmt::format(
        "{}: {} x {} texels of {} lights x {} views from {} images in {:.2f} s{}\n{}{}",
        r["output"]["path"].get<std::string>(), r["texels"][0].get<int>(),
        r["texels"][1].get<int>(), r["grid"]["lights"].get<int>(), r["grid"]["views"].get<int>(),
        r["plan"]["images_read"].get<int>(), r["time"]["total"].get<double>(), before, saved,
        advice);
}

std::string planText(const nlohmann::ordered_json& r) {
    std::string text;
    for (const auto& file : r["images"]) text += file.get<std::string>() + "\n";
    constexpr double kMega = 1e6;
    const auto& estimate = r["estimate"];
    text += fmt::format(
        "{} images, {:.1f} MB to read, about {:.0f} MB of memory, {:.1f} MB of output before "
        "compression\n",
        r["images"].size(), estimate["bytes_read"].get<double>() / kMega,
        estimate["memory"].get<double>() / kMega,
        estimate["output_bytes_uncompressed"].get<double>() / kMega);
    if (estimate["scratch_bytes"] != 0) {
        text += fmt::format(
            "each image is read once; {:.1f} MB that the memory does not hold go to a scratch file "
            "in {}\n",
            estimate["scratch_bytes"].get<double>() / kMega,
            estimate["scratch_folder"].get<std::string>());
    }
    return text;
}

/// Counts may lack: the report of an atlas that was kept is the one in its header.
void warnOfCounts(const nlohmann::ordered_json& counts) {
    const auto countOf = [&](const char* name) { return counts.value(name, std::uint64_t{0}); };
    if (const auto n = countOf("nonfinite")) {
        spdlog::warn("{} NaN, infinite or negative values were kept out", n);
    }
    if (const auto n = countOf("missing")) spdlog::warn("{} missing images were interpolated", n);
    if (const auto n = countOf("outside")) {
        spdlog::warn("{} pixels of the surface's plane lie outside their cropped image", n);
    }
    if (const auto n = countOf("dimmed")) {
        spdlog::info("{} values were dimmed to four times the texel's largest sample", n);
    }
    if (const auto n = countOf("clamped")) {
        spdlog::info("{} values were cut to the range that light can have", n);
    }
}

int run(Options options, const SharedOptions& shared, const ProgressSink& progress) {
    options.job.texels = texelsFromName(options.texels);
    options.job.plane = planeFrom(options.plane);
    options.atlas.giveTo(options.job);
    if (!options.budget.empty()) options.job.limits.budget = microsecondsFromText(options.budget);
    options.job.shard = shardFromText(options.shard);
    options.job.memory = shared.memoryBytes();
    if (isKept(options.noClobber, options.job.output)) return 0;
    if (options.dryRun) {
        const auto plan = planConvert(options.job);
        deliver(plan, planText(plan), shared);
        return 0;
    }
    const auto report = convert(options.job, progress);
    warnOfCounts(report.value("counts", nlohmann::ordered_json::object()));
    nlohmann::ordered_json full = report;
    full["threads"] = shared.threads;
    deliver(full, shared.quiet ? "" : summaryOf(full), shared);
    return 0;
}

}  // namespace

void addConvert(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("convert", "a BTF stack to a reconstructed ABRDF atlas");
    command->footer("Example: abrdf convert corduroy.zip -o corduroy.exr --plan greedy");
    auto options = std::make_shared<Options>();
    ConvertOptions& job = options->job;
    addInputOptions(*command, job.input);
    addMethodOptions(*command, job.method);
    addAtlasOutput(*command, job.output);
    const CLI::Option* method =
        command->add_option("--method", job.method.name, "see abrdf --list-methods")
            ->capture_default_str();
    command->add_option("--budget", options->budget,
                        "choose the most accurate method within this time an ABRDF: 50us, 1ms");
    command->add_option(
        "--tolerance", job.limits.tolerance,
        "choose the fewest samples whose expected mean Delta E is within it, and of each "
        "texel the smallest model whose estimated one is");
    command
        ->add_option("--exposure", job.method.options.exposure,
                     "factor on the values at which the tolerance is meant")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_flag("--strict", job.limits.strict,
                      "fail where nothing meets --budget and --tolerance");
    command
        ->add_option("--grid", job.grid,
                     "input | ubo81 | dome151 | utia288 | regular:THETASxPHIS | a CSV of "
                     "theta_deg,phi_deg")
        ->capture_default_str();
    command->add_option("--pairs", job.pairs,
                        "only what a scene shows: a CSV of theta_i,phi_i,theta_v,phi_v,weight in "
                        "degrees; grid, samples and rank are chosen for these pairs");
    addGrazingOption(*command, job.grazing);
    addTexelsOption(*command, options->texels);
    addPlaneOptions(*command, options->plane);
    options->atlas.outputSpace = job.outputSpace;
    addAtlasOptions(*command, options->atlas,
                    "angular | spatial | model: few numbers a texel, see abrdf expand",
                    "colour space of the atlas");
    command->add_flag("--dry-run", options->dryRun, "say what would be read and written");
    command->add_flag("--resume", job.resume,
                      "continue where an earlier run of the same job stopped");
    command->add_option("--shard", options->shard,
                        "only part I of N of the map, as 1/4; abrdf merge joins them");
    addNoClobberFlag(*command, options->noClobber);
    command->callback([options, method, &runCommand] {
        options->job.limits.methodIsOpen = method->count() == 0;
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            return run(*options, shared, progress);
        };
    });
}

}  // namespace abrdf
