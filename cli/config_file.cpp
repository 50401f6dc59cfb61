// SPDX-License-Identifier: BSD-3-Clause
#include "cli/config_file.h"

#include "abrdf/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace {

std::string textOf(const toml::node& node, const std::string& key, const std::string& file) {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const toml::array* array = node.as_array()) {
        std::string list;
        for (const toml::node& item : *array) {
            list += fmt::format("{}{}", list.empty() ? "" : ",", textOf(item, key, file));
        }
        return list;
    }
    throw std::runtime_error(
        fmt::format("{}:{}: the key {} needs a text, a number or a list of them", file,
                    node.source().begin.line, key));
}

}  // namespace

toml::table tableFromFile(const std::string& file) {
    try {
        return toml::parse(textOfFile(file), file);
    } catch (const toml::parse_error& error) {
        throw std::runtime_error(fmt::format("{}:{}: is not TOML: {}", file,
                                             error.source().begin.line,
                                             std::string(error.description())));
    }
}

std::vector<std::string> optionsFromTable(const toml::table& table, const std::string& file) {
    std::vector<std::string> options;
    for (const auto& [tomlKey, node] : table) {
        const std::string key(tomlKey.str());
        if (key == "config") {
            throw std::runtime_error(fmt::format("{}:{}: a job file cannot name another one", file,
                                                 node.source().begin.line));
        }
        if (const auto* flag = node.as_boolean()) {
            if (flag->get()) options.push_back(fmt::format("--{}", key));
        } else if (key == "input") {
            options.push_back(textOf(node, key, file));
        } else {
            options.push_back(fmt::format("--{}={}", key, textOf(node, key, file)));
        }
    }
    return options;
}

std::vector<std::string> withConfigFile(std::vector<std::string> words) {
    std::string file;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == "--config" && i + 1 < words.size()) {
            file = words[i + 1];
            words.erase(words.begin() + static_cast<std::ptrdiff_t>(i),
                        words.begin() + static_cast<std::ptrdiff_t>(i) + 2);
            break;
        }
        if (words[i].starts_with("--config=")) {
            file = words[i].substr(9);
            words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
            break;
        }
    }
    if (file.empty()) return words;
    const auto command =
        std::ranges::find_if(words, [](const std::string& word) { return !word.starts_with('-'); });
    const std::vector<std::string> options = optionsFromTable(tableFromFile(file), file);
    words.insert(command == words.end() ? command : command + 1, options.begin(), options.end());
    return words;
}

}  // namespace abrdf
