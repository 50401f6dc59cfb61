// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/angle_keys.h"

#include "abrdf/for_each_texel.h"
#include "stages/read/decode_image.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace abrdf {

namespace {

bool isDigit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

std::optional<NumberInName> numberAtBegin(std::string_view text) {
    std::size_t end = !text.empty() && text[0] == '-' ? 1 : 0;
    while (end < text.size() && isDigit(text[end])) ++end;
    if (end + 1 < text.size() && text[end] == '.' && isDigit(text[end + 1])) {
        ++end;
        while (end < text.size() && isDigit(text[end])) ++end;
    }
    double value = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + end, value);
    if (error != std::errc() || rest != text.data() + end) return {};
    return NumberInName{value, end};
}

std::optional<AngleKeys> angleKeysFromName(std::string_view path) {
    std::array<std::optional<double>, 4> found;
    constexpr std::array<std::string_view, 4> kKeys = {"tl", "pl", "tv", "pv"};
    for (std::size_t i = 0; i + 2 < path.size(); ++i) {
        if (i > 0 && isLetter(path[i - 1])) continue;
        const std::array<char, 2> key = {
            static_cast<char>(std::tolower(static_cast<unsigned char>(path[i]))),
            static_cast<char>(std::tolower(static_cast<unsigned char>(path[i + 1])))};
        for (std::size_t k = 0; k < kKeys.size(); ++k) {
            if (std::string_view(key.data(), 2) != kKeys[k]) continue;
            if (const auto number = numberAtBegin(path.substr(i + 2))) found[k] = number->value;
        }
    }
    for (const auto& value : found) {
        if (!value) return {};
    }
    return AngleKeys{*found[0], *found[1], *found[2], *found[3]};
}

std::vector<Photograph> photographsNamedByAngles(const FileSource& files) {
    const std::vector<std::string>& names = files.names();
    std::vector<std::optional<AngleKeys>> keysOf(names.size());
    forEachTexelBlock(names.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t file = begin; file < end; ++file) {
            if (isImageName(names[file])) keysOf[file] = angleKeysFromName(names[file]);
        }
    });
    std::vector<Photograph> photographs;
    for (std::size_t file = 0; file < names.size(); ++file) {
        if (const auto& keys = keysOf[file]) {
            photographs.push_back({file, keys->tl, keys->pl, keys->tv, keys->pv});
        }
    }
    return photographs;
}

std::optional<std::size_t> firstNamedByAngles(const FileSource& files) {
    for (std::size_t file = 0; file < files.names().size(); ++file) {
        const std::string& name = files.names()[file];
        if (isImageName(name) && angleKeysFromName(name)) return file;
    }
    return {};
}

}  // namespace abrdf
