// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/chart.h"

#include "abrdf/printable.h"
#include "cli/command.h"

#include <spdlog/spdlog.h>

namespace abrdf {

void addChart(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command =
        app.add_subcommand("chart", "error against time, samples and bytes: every method and size");
    command->footer(
        "Example: abrdf chart corduroy.zip wool.zip -o chart.svg --csv chart.csv\n"
        "         abrdf chart --calibrate    measures this machine, for convert --budget");
    struct Options {
        ChartOptions job;
        InputOptions shared;
        std::vector<std::string> inputs;
    };
    auto options = std::make_shared<Options>();
    ChartOptions& job = options->job;
    command->add_option("INPUT", options->inputs, "databases, BRDF files or atlases");
    addDatabaseOptions(*command, options->shared);
    command->add_option("-o,--output", job.output,
                        "the chart: .svg or .png, and the other one beside it");
    command->add_option("--csv", job.csv, "the figures over all inputs, a row a method and size");
    command->add_option("--method,--methods", job.methods, "one or more, with commas (else all)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--samples", job.samples, "sizes of the plans, with commas")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_option("--ranks", job.ranks, "of the prior's maps beside full, with commas")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->capture_default_str();
    command->add_option("--exposure", job.trial.exposure, "factor on the values")
        ->capture_default_str();
    command->add_flag("--calibrate", job.calibrate,
                      "keep the figures in the cache, for convert --budget and --tolerance; "
                      "without inputs only times are measured");
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            for (const std::string& input : options->inputs) {
                options->job.inputs.push_back(options->shared);
                options->job.inputs.back().input = input;
            }
            const auto report = chart(options->job, progress, [](const std::string& message) {
                spdlog::warn(printable(message));
            });
            deliver(report, chartTable(report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
