// SPDX-License-Identifier: BSD-3-Clause
#include "cli/batch_file.h"

#include "cli/config_file.h"

#include <fmt/format.h>
#include <glob.h>
#include <toml++/toml.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

/// Paths that a pattern stands for, sorted.
std::vector<std::string> pathsOf(const std::string& pattern, const std::string& where) {
    glob_t found{};
    std::vector<std::string> paths;
    if (glob(pattern.c_str(), GLOB_TILDE, nullptr, &found) == 0) {
        paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    }
    globfree(&found);
    if (paths.empty()) {
        throw std::runtime_error(fmt::format("{}: no file or folder is {}", where, pattern));
    }
    return paths;
}

std::string replaced(std::string text, const std::string& name) {
    constexpr std::string_view kName = "{name}";
    for (auto at = text.find(kName); at != std::string::npos; at = text.find(kName, at)) {
        text.replace(at, kName.size(), name);
        at += name.size();
    }
    return text;
}

/// "corduroy" of "materials/corduroy.zip" and of the folder "materials/corduroy/".
std::string nameOfInput(const fs::path& input) {
    const fs::path path = input.has_filename() ? input : input.parent_path();
    return (fs::is_directory(path) ? path.filename() : path.stem()).string();
}

std::vector<std::string> patternsOf(const toml::node& node, const std::string& where) {
    std::vector<std::string> patterns;
    const auto add = [&](const toml::node& item) {
        const auto text = item.value<std::string>();
        if (!item.is_string()) {
            throw std::runtime_error(
                fmt::format("{}: the key input needs a text or a list of them", where));
        }
        patterns.push_back(*text);
    };
    if (const toml::array* array = node.as_array()) {
        for (const toml::node& item : *array) add(item);
    } else {
        add(node);
    }
    return patterns;
}

/// Adds the materials that a table's own `input` names; `common`: keys that it lacks.
void addMaterials(const toml::table& own, const toml::table& common, const std::string& file,
                  std::vector<BatchItem>& items) {
    const toml::node* input = own.get("input");
    if (input == nullptr) return;
    const std::string where = fmt::format("{}:{}", file, input->source().begin.line);
    toml::table keys = common;
    for (const auto& [key, node] : own) keys.insert_or_assign(key, node);
    keys.erase("input");
    keys.erase("material");
    if (!keys.contains("output")) {
        throw std::runtime_error(
            fmt::format("{}: these inputs have no key output, as \"atlases/{{name}}.exr\"", where));
    }
    const std::vector<std::string> options = optionsFromTable(keys, file);
    for (const std::string& pattern : patternsOf(*input, where)) {
        for (const std::string& path : pathsOf(pattern, where)) {
            BatchItem item;
            item.input = path;
            const std::string name = nameOfInput(path);
            for (const std::string& option : options) {
                item.words.push_back(replaced(option, name));
                constexpr std::string_view kOutput = "--output=";
                if (item.words.back().starts_with(kOutput)) {
                    item.output = item.words.back().substr(kOutput.size());
                }
            }
            item.words.push_back(path);
            items.push_back(std::move(item));
        }
    }
}

}  // namespace

std::vector<BatchItem> batchFromFile(const fs::path& file) {
    const std::string name = file.string();
    const toml::table table = tableFromFile(name);
    std::vector<BatchItem> items;
    addMaterials(table, {}, name, items);
    if (const toml::node* materials = table.get("material")) {
        const toml::array* array = materials->as_array();
        if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
            throw std::runtime_error(fmt::format("{}:{}: write [[material]] before each of them",
                                                 name, materials->source().begin.line));
        }
        for (const toml::node& one : *array) addMaterials(*one.as_table(), table, name, items);
    }
    if (items.empty()) {
        throw std::runtime_error(fmt::format(
            "{}: names no input; it needs the key input, or [[material]] with it", name));
    }
    return items;
}

}  // namespace abrdf
