// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/output_file.h"
#include "abrdf/printable.h"
#include "cli/command.h"
#include "pipeline/convert/memory_plan.h"
#include "pipeline/json_text.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iostream>

namespace abrdf {

std::uint64_t SharedOptions::memoryBytes() const {
    return bytesFromText(memory.empty() ? "2G" : memory);
}

void addSharedOptions(CLI::App& app, SharedOptions& shared) {
    app.add_option("--threads", shared.threads,
                   "threads to use (else ABRDF_THREADS, CUE_THREADS, SLURM_CPUS_PER_TASK, all)")
        ->check(CLI::Range(1, 4096));
    app.add_option(
        "--memory", shared.memory,
        "bound on the resident set of convert, as 500M or 2G (2G); of a batch's all together");
    app.add_option("--progress", shared.progress, "auto | bar | plain | json | none")
        ->capture_default_str();
    app.add_option("--report", shared.report, "write a JSON report to this file");
    app.add_flag("--json", shared.json, "JSON on standard output instead of text");
    app.add_flag("-v,--verbose", shared.verbose, "say more");
    app.add_flag("-q,--quiet", shared.quiet, "say nothing but errors");
    app.add_option("--config", "a TOML file whose keys are the options' names");
}

void addReadOptions(CLI::App& command, ReadOptions& options) {
    command.add_option("--pattern", options.pattern,
                       "images' names of your own, as \"view_{tv}_{pv}/light_{tl}_{pl}.exr\"");
    command.add_option_function<std::string>(
        "--utia-encoding",
        [&options](const std::string& name) { options.utiaEncoding = utiaEncodingFromName(name); },
        "of UTIA BRDF files: linear | srgb | srgb140 (else told from the values)");
    command
        .add_option("--max-image-pixels", options.limits.imagePixels,
                    "of one image of a database; larger ones are refused")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40))
        ->capture_default_str();
    command.add_option_function<std::string>(
        "--max-file-size",
        [&options](const std::string& size) { options.limits.fileBytes = bytesFromText(size); },
        "of one image file, unpacked from its archive, as 500M or 2G (1G)");
}

void addGrazingOption(CLI::App& command, Grazing& grazing) {
    command.add_option_function<std::string>(
        "--grazing", [&grazing](const std::string& name) { grazing = grazingFromName(name); },
        "past the measured elevations: hold (the default) | fade | extrapolate");
}

void addColorConfigOption(CLI::App& command, std::optional<std::filesystem::path>& config) {
    command.add_option("--colorconfig", config,
                       "OpenColorIO config (else $OCIO, else the shipped one)");
}

void addTexelsOption(CLI::App& command, std::string& texels) {
    command.add_option("--texels", texels, "spatial resolution: WxH or full")
        ->capture_default_str();
}

void addNoClobberFlag(CLI::App& command, bool& noClobber) {
    command.add_flag("--no-clobber", noClobber, "keep an existing output");
}

bool isKept(bool noClobber, const std::filesystem::path& output) {
    if (!noClobber || !std::filesystem::exists(output)) return false;
    spdlog::info("{}: exists and is kept (--no-clobber)", output.string());
    return true;
}

void addInputOptions(CLI::App& command, InputOptions& options) {
    command
        .add_option("INPUT", options.input,
                    "folder or .zip of a BTF, a BRDF file, an atlas or a manifest")
        ->required();
    addDatabaseOptions(command, options);
}

void addDatabaseOptions(CLI::App& command, InputOptions& options) {
    addReadOptions(command, options.read);
    addColorConfigOption(command, options.colorConfig);
    command.add_option("--input-space", options.inputSpace,
                       "colour space of the images (else the database's convention)");
    const std::map<std::string, MissingImages> policies = {{"error", MissingImages::kError},
                                                           {"fill", MissingImages::kFill}};
    command.add_option("--missing", options.missing, "needed images that are absent: error | fill")
        ->transform(CLI::CheckedTransformer(policies));
    options.warn = [](const std::string& message) { spdlog::warn(printable(message)); };
}

void addMethodOptions(CLI::App& command, MethodChoice& choice) {
    PlanChoice& plan = choice.plan;
    command.add_option("--plan", plan.name,
                       "which samples to take: eight | poster | slices16 | greedy, with :N for at "
                       "most N, or a file (:N for its first N) (else the method's own)");
    command.add_option("--snap", plan.snap,
                       "degrees within which a measured pair, in both directions, stands for a "
                       "sample of the plan (10 for files; named plans: any)");
    command
        .add_option("--elevations", plan.elevations,
                    "plan poster: its two elevations in degrees (30,75)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--alpha", plan.alpha, "plan poster: its offset in degrees (90)");
    command.add_option("--axial", plan.axial, "plan poster: samples of an axial slice (24)");
    command.add_option("--diagonal", plan.diagonal,
                       "plan poster: samples of a diagonal slice (27)");
    command.add_option("--model", choice.prior.file,
                       "the prior's model from abrdf train (else the cache, else trained now)");
    command.add_option("--noise", choice.noise,
                       "relative noise of the samples (else 0.01 for 8-bit images, 0 for others)");
    command.add_option(
        "--saturated", choice.saturated,
        "samples at or above it are clipped and say only \"at least\"; 0: none (else "
        "0.99 for 8-bit images)");
    command
        .add_option("--rank", choice.options.rank,
                    "of the prior's maps: less is faster and less accurate; 0 is full")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command.add_flag("--per-texel", choice.options.perTexel,
                     "let the prior choose its model anew for each texel: slow");
}

void addPlaneOptions(CLI::App& command, PlaneOptions& options) {
    command
        .add_option("--plane", options.plane,
                    "height of the visible surface above the plane of rectification, in texels of "
                    "the images, to which they are shifted: auto finds it, off leaves it at 0")
        ->capture_default_str();
    command
        .add_option("--edges", options.edges,
                    "what lies beyond an image's edges: auto | periodic | cropped")
        ->capture_default_str();
    command.add_flag("--unshift", options.unshift, "give results back in the database's own frame");
}

PlaneChoice planeFrom(const PlaneOptions& options) {
    PlaneChoice choice = planeFromName(options.plane);
    choice.edges = edgesFromName(options.edges);
    choice.unshift = options.unshift;
    return choice;
}

void checkStandardOutput() {
    if (!std::cout.flush()) throw std::runtime_error("standard output cannot be written");
}

void deliver(const nlohmann::ordered_json& report, const std::string& text,
             const SharedOptions& shared) {
    const std::string json = jsonText(report, 2);
    if (!shared.report.empty()) writeWholeFile(shared.report, json + "\n");
    std::cout << (shared.json ? json + "\n" : text);
    checkStandardOutput();
}

}  // namespace abrdf
