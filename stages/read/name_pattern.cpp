// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/name_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace {

struct Key {
    std::string_view name;
    double AngleKeys::*value;
};
constexpr std::array kKeys{Key{"{tl}", &AngleKeys::tl}, Key{"{pl}", &AngleKeys::pl},
                           Key{"{tv}", &AngleKeys::tv}, Key{"{pv}", &AngleKeys::pv}};

}  // namespace

NamePattern::NamePattern(const std::string& text) {
    const auto fail = [&](const std::string& why) {
        return std::invalid_argument(fmt::format(
            "the pattern '{}' {}: it needs each of {{tl}} {{pl}} {{tv}} {{pv}} once, as in "
            "\"view_{{tv}}_{{pv}}/light_{{tl}}_{{pl}}.exr\"",
            text, why));
    };
    std::string_view rest(text);
    while (!rest.empty()) {
        const auto key =
            std::ranges::find_if(kKeys, [&](const Key& k) { return rest.starts_with(k.name); });
        if (key != kKeys.end()) {
            const auto same = [&](const Part& part) { return part.key == key->value; };
            if (std::ranges::any_of(parts_, same)) throw fail("has a key twice");
            parts_.push_back({{}, key->value});
            rest.remove_prefix(key->name.size());
        } else if (rest.front() == '{') {
            throw fail("has an unknown key");
        } else if (rest.front() == '*') {
            parts_.push_back({});
            rest.remove_prefix(1);
        } else {
            const std::size_t end = std::min(rest.find_first_of("{*"), rest.size());
            parts_.push_back({std::string(rest.substr(0, end)), nullptr});
            rest.remove_prefix(end);
        }
    }
    const auto keys = std::ranges::count_if(parts_, [](const Part& p) { return p.key != nullptr; });
    if (keys != static_cast<std::ptrdiff_t>(kKeys.size())) throw fail("lacks a key");
    if (parts_.size() > 64) throw fail("has too many parts");
}

std::optional<AngleKeys> NamePattern::match(std::string_view path) const {
    for (std::size_t begin = 0; begin <= path.size();) {
        AngleKeys keys;
        if (matchFrom(0, path.substr(begin), keys)) return keys;
        const std::size_t slash = path.find('/', begin);
        if (slash == std::string_view::npos) break;
        begin = slash + 1;
    }
    return {};
}

bool NamePattern::matchFrom(std::size_t part, std::string_view rest, AngleKeys& keys) const {
    if (part == parts_.size()) return rest.empty();
    const Part& p = parts_[part];
    if (!p.literal.empty()) {
        return rest.starts_with(p.literal) &&
               matchFrom(part + 1, rest.substr(p.literal.size()), keys);
    }
    if (p.key != nullptr) {
        const auto number = numberAtBegin(rest);
        if (!number) return false;
        keys.*p.key = number->value;
        return matchFrom(part + 1, rest.substr(number->length), keys);
    }
    for (std::size_t skipped = 0; skipped <= rest.size(); ++skipped) {
        if (matchFrom(part + 1, rest.substr(skipped), keys)) return true;
        if (skipped < rest.size() && rest[skipped] == '/') return false;
    }
    return false;
}

}  // namespace abrdf
