// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect.h"

#include "cli/command.h"

namespace abrdf {

void addInspect(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand(
        "inspect", "what a database or an atlas is, what is missing or odd in it");
    command->footer("Example: abrdf inspect corduroy.zip --json");
    auto path = std::make_shared<std::filesystem::path>();
    command->add_option("PATH", *path, "a database or an atlas")->required();
    command->callback([path, &runCommand] {
        runCommand = [path](const SharedOptions& shared, const ProgressSink& progress) {
            const auto report = inspect(*path, progress);
            deliver(report, textOf(report), shared);
            return report["complete"].get<bool>() ? 0 : 1;
        };
    });
}

}  // namespace abrdf
