// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan.h"

#include "cli/command.h"
#include "pipeline/plan/plan_report.h"

namespace abrdf {

void addPlan(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("plan", "which samples to take, by falling worth");
    command->footer(
        "Example: abrdf plan --continuous --samples 100 -o plan.toml\n"
        "         abrdf convert corduroy.zip --plan plan.toml:52 -o corduroy.exr");
    auto job = std::make_shared<PlanJob>();
    command->add_option("--samples", job->samples, "how many, 1 to 5000; slices: at most")
        ->check(CLI::Range(1, 5000))
        ->capture_default_str();
    CLI::Option* grid =
        command
            ->add_option("--grid", job->grid,
                         "choose among all pairs of ubo81 | dome151 | utia288 | "
                         "regular:THETASxPHIS (fine ones are as good as free) | a CSV of "
                         "theta_deg,phi_deg")
            ->capture_default_str();
    command->add_option("--input", job->input, "choose among the images of this database")
        ->excludes(grid);
    addReadOptions(*command, job->read);
    command->add_option("--pairs", job->pairs,
                        "only what a scene shows counts: a CSV of "
                        "theta_i,phi_i,theta_v,phi_v,weight in degrees");
    CLI::Option* continuous = command->add_flag(
        "--continuous", job->continuous,
        "whole slices that a goniometer sweeps; --grid or --input are what is to be reconstructed");
    command
        ->add_option("--elevations", job->elevations,
                     "of light and sensor in the slices, degrees (15,30,45,60,75)")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->needs(continuous);
    command
        ->add_option("--travel", job->travel,
                     "slices that are near one another: a full turn counts as so many samples (0)")
        ->needs(continuous);
    command
        ->add_option("--materials", job->materials,
                     "random materials of each class (0: 200 to 1000 by the grid)")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    command->add_option("--seed", job->seed, "of the random materials")->capture_default_str();
    command->add_option("-o,--output", job->output, "the file, for --plan: .toml")->required();
    command->callback([job, &runCommand] {
        runCommand = [job](const SharedOptions& shared, const ProgressSink& progress) {
            const auto report = plan(*job, progress);
            deliver(report, planSummary(report), shared);
            return 0;
        };
    });
}

}  // namespace abrdf
