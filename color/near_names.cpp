// SPDX-License-Identifier: BSD-3-Clause
#include "color/near_names.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

namespace abrdf {

namespace {

// Lower-case letters and digits alone: people do not agree on the rest of "Linear Rec.709 (sRGB)".
std::string folded(std::string_view name) {
    std::string letters;
    for (const char c : name) {
        if (c >= 'A' && c <= 'Z') {
            letters += static_cast<char>(c - 'A' + 'a');
        } else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
            letters += c;
        }
    }
    return letters;
}

// The fewest insertions, deletions, replacements and swaps of neighbours from a to b: Levenshtein's
// distance with Damerau's fourth error, for "ACESgc" is one slip of the hand.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> beforeLast, last, row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        beforeLast = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], beforeLast[j - 2] + 1);
            }
        }
    }
    return row.back();
}

// How far `name` is from what was `typed`; nothing where they have too little in common.
std::optional<std::size_t> farness(const std::string& typed, const std::string& name) {
    constexpr std::size_t kShortestPart = 2;
    const std::string a = folded(typed);
    const std::string b = folded(name);
    const std::size_t distance = editDistance(a, b);
    if (distance <= std::max<std::size_t>(1, std::min(a.size(), b.size()) / 4)) return distance;
    const bool part = a.size() >= kShortestPart && b.find(a) != std::string::npos;
    return part ? std::optional(distance) : std::nullopt;
}

}  // namespace

std::vector<std::string> nearNames(const std::string& typed,
                                   const std::vector<std::vector<std::string>>& known) {
    constexpr std::size_t kMost = 3;
    std::vector<std::pair<std::size_t, std::string>> found;
    for (const std::vector<std::string>& names : known) {
        std::optional<std::pair<std::size_t, std::string>> best;
        for (const std::string& name : names) {
            const auto far = farness(typed, name);
            if (far && (!best || *far < best->first)) best.emplace(*far, name);
        }
        if (best) found.push_back(*best);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    found.resize(std::min(found.size(), kMost));
    std::vector<std::string> names;
    for (auto& [far, name] : found) names.push_back(std::move(name));
    return names;
}

bool sameLetters(const std::string& a, const std::string& b) {
    const auto lower = [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    };
    return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace abrdf
