// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/train/train.h"

#include "abrdf/printable.h"
#include "cli/command.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace abrdf {

void addTrain(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command =
        app.add_subcommand("train", "the prior's model ahead of time, into the cache or a file");
    command->footer("Example: abrdf train --plan greedy:100 --grid ubo81 -o greedy100.model");
    auto job = std::make_shared<TrainJob>();
    command->add_option(
        "--plan", job->plan.name,
        "eight | poster | slices16 | greedy, with :N for at most N samples, or a file");
    command->add_option("--snap", job->plan.snap,
                        "degrees within which the grid must have a sample of the plan (10 for "
                        "files; named plans: any)");
    command
        ->add_option("--grid", job->grid,
                     "of the database, and of the atlas: ubo81 | dome151 | utia288 | "
                     "regular:THETASxPHIS | a CSV of theta_deg,phi_deg")
        ->capture_default_str();
    command->add_option("--output-grid", job->outputGrid, "of the atlas, where it is another one");
    command->add_flag("--anywhere", job->anywhere,
                      "for BRDF tables: samples where the plan says, not at the grid's directions");
    command->add_option("-o,--output", job->output, "a file for --model (else the cache)");
    command
        ->add_option("--materials", job->options.materials,
                     "random materials of each class (0: 500 to 2000 by the grid)")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command->add_option("--seed", job->options.seed, "of the random materials")
        ->capture_default_str();
    command->callback([job, &runCommand] {
        runCommand = [job](const SharedOptions& shared, const ProgressSink& progress) {
            const auto report = train(*job, progress, [](const std::string& message) {
                spdlog::warn(printable(message));
            });
            deliver(report,
                    fmt::format("{}: {} samples of the plan {}, {:.1f} MB, {:.1f} s\n",
                                report["output"]["path"].get<std::string>(),
                                report["plan"]["samples"].get<std::size_t>(),
                                report["plan"]["name"].get<std::string>(),
                                report["output"]["bytes"].get<double>() / 1e6,
                                report["time"].get<double>()),
                    shared);
            return 0;
        };
    });
}

}  // namespace abrdf
