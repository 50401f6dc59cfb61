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
        if (const auto keys = matchWhole(path.substr(begin))) return keys;
        const std::size_t slash = path.find('/', begin);
        if (slash == std::string_view::npos) break;
        begin = slash + 1;
    }
    return {};
}

std::optional<std::size_t> NamePattern::matchPart(const Part& part, std::string_view rest,
                                                  AngleKeys& keys) {
    if (!part.literal.empty()) {
        return rest.starts_with(part.literal) ? std::optional(part.literal.size()) : std::nullopt;
    }
    const auto number = numberAtBegin(rest);
    if (!number) return {};
    keys.*part.key = number->value;
    return number->length;
}

std::optional<AngleKeys> NamePattern::matchWhole(std::string_view name) const {
    // Only the last * needs to give: what an earlier one could take, the later one can as well.
    std::optional<std::size_t> star;
    std::size_t afterStar = 0;
    std::size_t part = 0;
    std::size_t place = 0;
    AngleKeys keys;
    while (part < parts_.size() || place < name.size()) {
        if (part < parts_.size() && parts_[part].isAnything()) {
            star = part++;
            afterStar = place;
            continue;
        }
        const auto length =
            part < parts_.size() ? matchPart(parts_[part], name.substr(place), keys) : std::nullopt;
        if (length) {
            place += *length;
            ++part;
        } else {
            if (!star || afterStar >= name.size() || name[afterStar] == '/') return {};
            place = ++afterStar;
            part = *star + 1;
        }
    }
    return keys;
}

}  // namespace abrdf
