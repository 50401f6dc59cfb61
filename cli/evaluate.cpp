// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate.h"

#include "cli/command.h"

namespace abrdf {

void addEvaluate(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command =
        app.add_subcommand("evaluate", "reconstructions against the full measurement");
    command->footer(
        "Example: abrdf evaluate corduroy.zip --method published,prior --sheet sheet.png");
    struct Options {
        EvaluateOptions job;
        std::string texels = "1x1";
        PlaneOptions plane;
    };
    auto options = std::make_shared<Options>();
    addInputOptions(*command, options->job.input);
    addMethodOptions(*command, options->job.choice);
    command->add_option("--method,--methods", options->job.methods, "one or more, with commas")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_option("--texels", options->texels, "spatial resolution: WxH or full")
        ->capture_default_str();
    addPlaneOptions(*command, options->plane);
    command
        ->add_option("--exposure", options->job.exposure, "factor on the values, natural exposure")
        ->capture_default_str();
    command->add_option("--sheet", options->job.sheet, "contact sheet, a PNG");
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            options->job.texels = texelsFromName(options->texels);
            options->job.plane = planeFrom(options->plane);
            const auto report = evaluate(options->job, progress);
            deliver(report, tableOf(report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
