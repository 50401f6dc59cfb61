// SPDX-License-Identifier: BSD-3-Clause
#include "cli/suggestion.h"

#include <algorithm>
#include <numeric>

namespace abrdf {

namespace {

/// Levenshtein's distance.
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
        }
    }
    return row[b.size()];
}

std::vector<std::string> namesOf(const CLI::App& app, bool chosenOnly) {
    std::vector<std::string> names;
    const auto addOptions = [&](const CLI::App& of) {
        for (const CLI::Option* option : of.get_options()) {
            for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        }
    };
    addOptions(app);
    for (const CLI::App* command : app.get_subcommands({})) {
        names.push_back(command->get_name());
        if (!chosenOnly || command->parsed()) addOptions(*command);
    }
    return names;
}

}  // namespace

std::string suggestion(const CLI::App& app, const std::vector<std::string>& words) {
    const bool commandChosen = !app.get_subcommands().empty();
    const std::vector<std::string> names = namesOf(app, commandChosen);
    for (const std::string& word : words) {
        const std::string name = word.substr(0, word.find('='));
        if (commandChosen && !name.starts_with("--")) continue;
        if (std::ranges::find(names, name) != names.end()) continue;
        const auto nearest = std::ranges::min_element(
            names, {}, [&](const std::string& known) { return editDistance(name, known); });
        if (editDistance(name, *nearest) <= 3) return "; did you mean " + *nearest + "?";
    }
    return {};
}

}  // namespace abrdf
