// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace abrdf {

std::string textOfFile(const std::filesystem::path& file) {
    constexpr std::size_t kMost = std::size_t{1} << 26;
    constexpr std::size_t kStep = std::size_t{1} << 16;
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw std::runtime_error(fmt::format("{}: is a folder, not a file", file.string()));
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
    }
    std::string text;
    while (stream) {
        const std::size_t before = text.size();
        text.resize(before + kStep);
        stream.read(text.data() + before, kStep);
        text.resize(before + static_cast<std::size_t>(stream.gcount()));
        if (text.size() > kMost) {
            throw std::runtime_error(fmt::format(
                "{}: is larger than 64 MB, which no job, plan, list or report is", file.string()));
        }
    }
    if (stream.bad()) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
    return text;
}

std::string shownLine(const std::string& line) {
    constexpr std::size_t kMost = 80;
    return line.size() <= kMost ? line : line.substr(0, kMost) + " ...";
}

bool isLineOfNames(const std::string& line) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || std::isalpha(static_cast<unsigned char>(line[first])) == 0) {
        return false;
    }
    char* end = nullptr;
    std::strtod(line.c_str() + first, &end);
    return end == line.c_str() + first;
}

}  // namespace abrdf
