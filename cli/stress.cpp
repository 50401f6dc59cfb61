// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress.h"

#include "abrdf/printable.h"
#include "cli/command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace abrdf {

void addStress(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("stress", "where methods fail");
    command->footer("Example: abrdf stress --methods published,prior -o stress");
    auto job = std::make_shared<StressOptions>();
    command->add_option("INPUT", job->inputs,
                        "materials: databases or BRDF tables (else analytic ones)");
    command->add_option("-o,--output", job->output, "folder of the figures and stress.json")
        ->required();
    command->add_option("--method,--methods", job->methods, "with commas (else all)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option("--cases", job->cases, "with commas (else all)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command->add_option(
        "--plan", job->plan.name,
        "eight | slices16 | greedy, with :N for at most N samples, or a file (else eight)");
    command->add_option("--snap", job->plan.snap,
                        "degrees within which the grid must have a sample of the plan (10 for "
                        "files; named plans: any)");
    command->add_option("--grid", job->grid, "directions of the database that is played")
        ->capture_default_str();
    command
        ->add_option("--materials", job->prior.train.materials,
                     "random materials of each class that the prior learns from (0: by the grid)")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command->add_option("--seed", job->seed, "of noise and losses")->capture_default_str();
    addColorConfigOption(*command, job->colorConfig);
    command->callback([job, &runCommand] {
        runCommand = [job](const SharedOptions& shared, const ProgressSink& progress) {
            const auto report = stress(*job, progress, [](const std::string& message) {
                spdlog::warn(printable(message));
            });
            deliver(report, breakdownTable(report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
