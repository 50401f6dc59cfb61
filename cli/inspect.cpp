// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/inspect.h"

#include "cli/command.h"

namespace abrdf {

void addInspect(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand(
        "inspect", "what a database or an atlas is, what is missing or odd in it");
    command->footer("Example: abrdf inspect corduroy.zip --json");
    struct Options {
        std::filesystem::path path;
        ReadOptions read;
    };
    auto options = std::make_shared<Options>();
    command->add_option("PATH", options->path, "a database or an atlas")->required();
    addReadOptions(*command, options->read);
    command->callback([options, &runCommand] {
        runCommand = [options](const SharedOptions& shared, const ProgressSink& progress) {
            const auto report = inspect(options->path, progress, options->read);
            deliver(report, textOf(report), shared);
            return report["complete"].get<bool>() ? 0 : 1;
        };
    });
}

}  // namespace abrdf
