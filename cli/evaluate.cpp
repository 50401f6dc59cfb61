// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate.h"

#include "cli/command.h"
#include "pipeline/named_pair.h"

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
        std::vector<std::string> pairs;
    };
    auto options = std::make_shared<Options>();
    addInputOptions(*command, options->job.input);
    addMethodOptions(*command, options->job.choice);
    command->add_option("--method,--methods", options->job.methods, "one or more, with commas")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    addTexelsOption(*command, options->texels);
    addPlaneOptions(*command, options->plane);
    command
        ->add_option("--tolerance", options->job.choice.options.tolerance,
                     "prior: of each texel the smallest model whose estimated Delta E is within")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--exposure", options->job.exposure, "factor on the values, natural exposure")
        ->capture_default_str();
    command->add_option("--pairs", options->job.pairs,
                        "only what a scene shows, as a CSV of theta_i,phi_i,theta_v,phi_v,weight "
                        "in degrees: samples are chosen and errors counted for these pairs");
    command->add_option("--sheet", options->job.sheet, "contact sheet, a PNG");
    command
        ->add_option("--pair", options->pairs,
                     "THETA_I,PHI_I,THETA_V,PHI_V in degrees: images of texels that the sheet "
                     "shows; may be repeated")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            options->job.texels = texelsFromName(options->texels);
            options->job.plane = planeFrom(options->plane);
            if (!options->pairs.empty()) options->job.imagePairs.clear();
            for (const std::string& pair : options->pairs) {
                options->job.imagePairs.push_back(pairFrom(pair));
            }
            const auto report = evaluate(options->job, progress);
            deliver(report, tableOf(report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
