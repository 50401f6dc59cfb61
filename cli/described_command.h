// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace abrdf {

/// What may stand after an option, or in a positional's place.
enum class Value {
    kNone,    ///< A flag.
    kNumber,  ///< Nothing that a shell could know.
    kName,    ///< One of `choices`.
    kFile,    ///< A file, or one of `choices`.
};

struct DescribedOption {
    std::vector<std::string> names;  ///< "-o", "--output"; of a positional "INPUT".
    std::string text;
    Value value = Value::kNone;
    std::vector<std::string> choices;
    std::string fallback;  ///< Its default; empty where there is none to tell.
    bool required = false;
    bool many = false;
};

/// A command of the program as CLI11 knows it, for manuals and shells: both can so never drift from
/// what --help says.
struct DescribedCommand {
    std::string name;
    std::string text;
    std::string example;
    std::vector<DescribedOption> positionals;
    std::vector<DescribedOption> options;
};

/// The program itself, or one of its commands.
DescribedCommand described(const CLI::App& app);

/// All commands that --help lists.
std::vector<DescribedCommand> describedCommands(const CLI::App& program);

/// The names in a text such as "past the elevations: hold (the default) | fade | extrapolate".
std::vector<std::string> choicesIn(const std::string& text);

}  // namespace abrdf
