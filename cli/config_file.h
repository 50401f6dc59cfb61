// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>
#include <vector>

namespace abrdf {

/// Puts the keys of a TOML job file (--config FILE) into the command line as options, before the
/// user's own words, which so win over it. `words`: the program's arguments without its name; the
/// first one that is no option is the command. A key `texels = "64x64"` stands for --texels 64x64,
/// `dry-run = true` for --dry-run, an array for a list with commas, `input` for INPUT.
/// Throws std::runtime_error that names the file and the line.
std::vector<std::string> withConfigFile(std::vector<std::string> words);

/// The table of a TOML file. Throws std::runtime_error that names the file and the line.
toml::table tableFromFile(const std::string& file);

/// Its keys as options, "--texels=64x64"; `input` comes as its bare text.
std::vector<std::string> optionsFromTable(const toml::table& table, const std::string& file);

}  // namespace abrdf
