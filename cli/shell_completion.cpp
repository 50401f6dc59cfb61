// SPDX-License-Identifier: BSD-3-Clause
#include "cli/shell_completion.h"

#include "cli/described_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace abrdf {

namespace {

/// Between single quotes of a shell.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

/// Fish knows \' between single quotes.
std::string fishQuoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'' || c == '\\') result += '\\';
        result += c;
    }
    return result + "'";
}

/// The options of a command, and those of the program, which may stand behind it.
std::vector<DescribedOption> allOptions(const DescribedCommand& command,
                                        const DescribedCommand& program) {
    std::vector<DescribedOption> options = command.options;
    for (const DescribedOption& option : program.options) {
        const std::string& name = option.names.back();
        if (name != "--help" && name != "--version" && name != "--list-methods") {
            options.push_back(option);
        }
    }
    return options;
}

std::string bashCase(const DescribedCommand& command, const std::vector<DescribedOption>& options) {
    std::string names;
    std::string values;
    for (const DescribedOption& option : options) {
        for (const std::string& name : option.names) names += name + " ";
        if (option.value == Value::kNone) continue;
        std::string patterns;
        for (const std::string& name : option.names) {
            patterns += fmt::format("{}{}", patterns.empty() ? "" : "|", name);
        }
        values += fmt::format("                {}) choices='{}' files={} ;;\n", patterns,
                              fmt::join(option.choices, " "), option.value == Value::kFile ? 1 : 0);
    }
    names.pop_back();
    return fmt::format(
        "        {})\n            options='{}'\n            case $previous in\n{}                "
        "*) "
        "value=0 ;;\n            esac ;;\n",
        command.name.empty() ? "''" : command.name, names, values);
}

/// A specification of zsh's _arguments.
std::string zshOption(const DescribedOption& option) {
    std::string text;
    for (const char c : option.text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') text += '\\';
        text += c;
    }
    std::string value;
    if (option.value == Value::kNumber) value = ":number: ";
    if (option.value == Value::kName) {
        value = fmt::format(":name:({})", fmt::join(option.choices, " "));
    }
    if (option.value == Value::kFile) {
        value =
            option.choices.empty()
                ? ":file:_files"
                : fmt::format(":value:_alternative \"name\\:name\\:({})\" \"file\\:file\\:_files\"",
                              fmt::join(option.choices, " "));
    }
    std::string specifications;
    for (const std::string& name : option.names) {
        const std::string before =
            option.many ? "*" : fmt::format("({})", fmt::join(option.names, " "));
        specifications += fmt::format("        {} \\\n",
                                      quoted(fmt::format("{}{}[{}]{}", before, name, text, value)));
    }
    return specifications;
}

std::string fishOption(const DescribedOption& option, const std::string& condition) {
    std::string line = fmt::format("complete -c abrdf -n {}", fishQuoted(condition));
    for (const std::string& name : option.names) {
        line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    }
    if (option.value == Value::kFile) line += " -r -F";
    if (option.value == Value::kName || option.value == Value::kNumber) line += " -x";
    if (!option.choices.empty()) {
        line += fmt::format(" -a '{}'", fmt::join(option.choices, " "));
    }
    return line + " -d " + fishQuoted(option.text) + "\n";
}

}  // namespace

std::string bashCompletion(const CLI::App& app) {
    DescribedCommand program = described(app);
    program.name.clear();
    std::string names;
    std::string cases = bashCase(program, program.options);
    for (const DescribedCommand& command : describedCommands(app)) {
        names += fmt::format("{}{}", names.empty() ? "" : "|", command.name);
        cases += bashCase(command, allOptions(command, program));
    }
    std::string words = names;
    std::ranges::replace(words, '|', ' ');
    return fmt::format(R"(# bash completion of abrdf, made by the program itself.
_abrdf() {{
    local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
    local command='' options choices='' files=1 value=1 word
    # Bash splits --option=value into three words.
    [[ $previous == = ]] && previous=${{COMP_WORDS[COMP_CWORD-2]}}
    [[ $current == = ]] && current=''
    for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
        case $word in {0}) command=$word; break ;; esac
    done
    case $command in
{1}    esac
    if [[ $value == 1 ]]; then
        COMPREPLY=($(compgen -W "$choices" -- "$current"))
    elif [[ $current == -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$current"))
        files=0
    elif [[ -z $command ]]; then
        COMPREPLY=($(compgen -W '{2}' -- "$current"))
        files=0
    fi
    if [[ $files == 1 ]]; then
        compopt -o filenames 2> /dev/null
        local IFS=$'\n'
        COMPREPLY+=($(compgen -f -- "$current"))
    fi
}}
complete -F _abrdf abrdf
)",
                       names, cases, words);
}

std::string zshCompletion(const CLI::App& app) {
    const DescribedCommand program = described(app);
    std::string commands;
    std::string cases;
    for (const DescribedCommand& command : describedCommands(app)) {
        commands += fmt::format("        {}\n", quoted(command.name + ":" + command.text));
        cases += fmt::format("    {})\n        _arguments -s \\\n", command.name);
        for (const DescribedOption& option : allOptions(command, program)) {
            cases += zshOption(option);
        }
        cases += "        '*:file:_files' ;;\n";
    }
    std::string shared;
    for (const DescribedOption& option : program.options) shared += zshOption(option);
    return fmt::format(R"(#compdef abrdf
# zsh completion of abrdf, made by the program itself.
_abrdf() {{
    local context state state_descr line
    typeset -A opt_args
    local -a commands=(
{}    )
    _arguments -C -s \
{}        '1:command:->command' '*::argument:->argument'
    [[ $state == command ]] && _describe command commands
    [[ $state == argument ]] && case $words[1] in
{}    esac
}}
_abrdf "$@"
)",
                       commands, shared, cases);
}

std::string fishCompletion(const CLI::App& app) {
    const DescribedCommand program = described(app);
    std::string text = "# fish completion of abrdf, made by the program itself.\n";
    for (const DescribedOption& option : program.options) {
        text += fishOption(option, "__fish_use_subcommand");
    }
    for (const DescribedCommand& command : describedCommands(app)) {
        text += fmt::format("complete -c abrdf -f -n __fish_use_subcommand -a {} -d {}\n",
                            command.name, fishQuoted(command.text));
        for (const DescribedOption& option : allOptions(command, program)) {
            text += fishOption(option, "__fish_seen_subcommand_from " + command.name);
        }
    }
    return text;
}

}  // namespace abrdf
