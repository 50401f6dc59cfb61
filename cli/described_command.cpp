// SPDX-License-Identifier: BSD-3-Clause
#include "cli/described_command.h"

#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <regex>

namespace abrdf {

namespace {

DescribedOption describedOption(const CLI::Option& option) {
    DescribedOption result;
    result.text = option.get_description();
    result.required = option.get_required();
    result.many = option.get_expected_max() > 1;
    result.fallback = option.get_default_str();
    if (option.get_positional()) {
        result.names.push_back(option.get_name(true));
    } else {
        for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
    }
    if (option.get_items_expected_max() == 0) return result;
    result.choices = choicesIn(result.text);
    if (result.names.back().starts_with("--method")) {
        for (const Method& method : methods()) result.choices.emplace_back(method.name);
    }
    const std::string type = option.get_type_name();
    const bool namesFile = result.text.find("file") != std::string::npos ||
                           result.text.find("CSV") != std::string::npos;
    if (type.starts_with("INT") || type.starts_with("FLOAT") || type.starts_with("UINT")) {
        result.value = Value::kNumber;
    } else {
        result.value = result.choices.empty() || namesFile ? Value::kFile : Value::kName;
    }
    return result;
}

}  // namespace

std::vector<std::string> choicesIn(const std::string& text) {
    // A name of a choice, with a remark in brackets or none.
    static const std::string name = "[a-z0-9][a-z0-9_.-]*";
    static const std::regex chain(name + R"((?: \([^)]*\))?(?: \| )" + name +
                                  R"((?: \([^)]*\))?(?=$|[,;:]| \||\)| \())+)");
    std::smatch found;
    if (!std::regex_search(text, found, chain)) return {};
    const std::string list = std::regex_replace(found.str(), std::regex(R"( \([^)]*\))"), "");
    std::vector<std::string> choices;
    const std::regex word(name);
    for (std::sregex_iterator it(list.begin(), list.end(), word), end; it != end; ++it) {
        choices.push_back(it->str());
    }
    return choices;
}

DescribedCommand described(const CLI::App& app) {
    DescribedCommand command{app.get_name(), app.get_description(), app.get_footer(), {}, {}};
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_group().empty()) continue;
        (option->get_positional() ? command.positionals : command.options)
            .push_back(describedOption(*option));
    }
    return command;
}

std::vector<DescribedCommand> describedCommands(const CLI::App& program) {
    std::vector<DescribedCommand> commands;
    for (const CLI::App* app : program.get_subcommands({})) {
        if (!app->get_group().empty()) commands.push_back(described(*app));
    }
    return commands;
}

}  // namespace abrdf
