// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/expand.h"

#include "cli/atlas_options.h"
#include "cli/command.h"

#include <fmt/format.h>

namespace abrdf {

namespace {

struct Options {
    ExpandOptions job;
    AtlasOptions atlas;
    bool noClobber = false;
};

int run(Options options, const SharedOptions& shared, const ProgressSink& progress) {
    ExpandOptions& job = options.job;
    options.atlas.giveTo(job);
    job.memory = shared.memoryBytes();
    if (isKept(options.noClobber, job.output)) return 0;
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
    addAtlasOutput(*command, job.output);
    command->add_option("--colorconfig", job.colorConfig, "an OpenColorIO config (else $OCIO)");
    command->add_option("--grid", job.grid, "as of convert; input: the model's own")
        ->capture_default_str();
    addGrazingOption(*command, job.grazing);
    addAtlasOptions(*command, options->atlas, "angular | spatial",
                    "colour space (the model's own)");
    addNoClobberFlag(*command, options->noClobber);
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            return run(*options, shared, progress);
        };
    });
}

}  // namespace abrdf
