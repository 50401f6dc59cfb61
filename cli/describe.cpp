// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command.h"
#include "cli/man_page.h"
#include "cli/shell_completion.h"

#include <iostream>

namespace abrdf {

namespace {

std::string descriptionAs(const std::string& form, const CLI::App& program) {
    if (form == "man") return manPage(program);
    if (form == "bash") return bashCompletion(program);
    if (form == "zsh") return zshCompletion(program);
    return fishCompletion(program);
}

}  // namespace

void addDescribe(CLI::App& app, RunCommand& runCommand) {
    CLI::App* command = app.add_subcommand("describe", "the manual page, or a shell's completions");
    command->group("");  // For the build; users have its results.
    auto form = std::make_shared<std::string>();
    command->add_option("FORM", *form, "man | bash | zsh | fish")
        ->required()
        ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
    command->callback([form, &app, &runCommand] {
        runCommand = [form, &app](const SharedOptions&, const ProgressSink&) {
            std::cout << descriptionAs(*form, app);
            checkStandardOutput();
            return 0;
        };
    });
}

}  // namespace abrdf
