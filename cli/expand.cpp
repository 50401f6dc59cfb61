// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/expand.h"

#include "cli/command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace abrdf {

namespace {

struct Options {
    ExpandOptions job;
    std::string layout = "angular";
    std::string compression = "zip";
    std::string cosine = "keep";
    bool noClobber = false;
};

int run(Options options, const SharedOptions& shared, const ProgressSink& progress) {
    ExpandOptions& job = options.job;
    job.layout = atlasKindFromName(options.layout);
    job.compression = compressionFromName(options.compression);
    job.divideCosine = options.cosine == "divide";
    job.memory = shared.memoryBytes();
    if (options.noClobber && std::filesystem::exists(job.output)) {
        spdlog::info("{}: exists and is kept (--no-clobber)", job.output.string());
        return 0;
    }
    const auto report = expand(job, progress);
    const std::string text =
        fmt::format("{}: {} x {} texels of {} lights x {} views in {:.2f} s\n",
                    report["output"]["path"].get<std::string>(), report["texels"][0].get<int>(),
                    report["texels"][1].get<int>(), report["grid"]["lights"].get<int>(),
                    report["grid"]["views"].get<int>(), report["time"]["total"].get<double>());
    deliver(report, shared.quiet ? "" : text, shared);
    return 0;
}

}  // namespace

void addExpand(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command =
        app.add_subcommand("expand", "a model atlas into one of all pairs, or onto another grid");
    command->footer("Example: abrdf expand model.exr -o atlas.exr --layout spatial");
    auto options = std::make_shared<Options>();
    ExpandOptions& job = options->job;
    command->add_option("ATLAS", job.input, "an atlas of convert --layout model")->required();
    command->add_option("-o,--output", job.output, "the atlas, an OpenEXR file")->required();
    command->add_option("--colorconfig", job.colorConfig, "an OpenColorIO config (else $OCIO)");
    command->add_option("--grid", job.grid, "as of convert; input: the model's own")
        ->capture_default_str();
    addGrazingOption(*command, job.grazing);
    command->add_option("--layout", options->layout, "angular | spatial")->capture_default_str();
    const std::map<std::string, PixelChoice> pixels = {
        {"auto", PixelChoice::kAuto}, {"half", PixelChoice::kHalf}, {"float", PixelChoice::kFloat}};
    command->add_option("--pixel", job.pixel, "auto | half | float")
        ->transform(CLI::CheckedTransformer(pixels));
    command->add_option("--compression", options->compression, "none | zips | zip | piz")
        ->capture_default_str();
    command->add_option("--output-space", job.outputSpace, "colour space (the model's own)");
    command->add_option("--cosine", options->cosine, "cos(theta_i) in the values: keep | divide")
        ->check(CLI::IsMember({"keep", "divide"}))
        ->capture_default_str();
    command->add_flag("--no-clobber", options->noClobber, "keep an existing output");
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            return run(*options, shared, progress);
        };
    });
}

}  // namespace abrdf
