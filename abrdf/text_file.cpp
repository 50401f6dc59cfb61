// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/text_file.h"

#include "abrdf/cancel.h"
#include "abrdf/file_descriptor.h"
#include "abrdf/printable.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace abrdf {

namespace {

/// As read(2), once there is something, or an end.
ssize_t readSome(const FileDescriptor& file, char* bytes, std::size_t count) {
    constexpr int kPatience = 100;  // Milliseconds between looks for an interrupt.
    while (true) {
        throwIfCancelled();
        pollfd waited{file.number(), POLLIN, 0};
        if (poll(&waited, 1, kPatience) <= 0) continue;
        const ssize_t got = read(file.number(), bytes, count);
        if (got >= 0 || (errno != EINTR && errno != EAGAIN)) return got;
    }
}

}  // namespace

std::string textOfFile(const std::filesystem::path& file) {
    constexpr std::size_t kMost = std::size_t{1} << 26;
    constexpr std::size_t kStep = std::size_t{1} << 16;
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw std::runtime_error(fmt::format("{}: is a folder, not a file", file.string()));
    }
    // Not blocking, so that a pipe without a writer can be given up.
    const FileDescriptor opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!opened.isOpen()) {
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
    }
    std::string text;
    while (true) {
        const std::size_t before = text.size();
        text.resize(before + kStep);
        const ssize_t got = readSome(opened, text.data() + before, kStep);
        if (got < 0) {
            throw std::runtime_error(
                fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
        }
        text.resize(before + static_cast<std::size_t>(got));
        if (got == 0) return text;
        if (text.size() > kMost) {
            throw std::runtime_error(fmt::format(
                "{}: is larger than 64 MB, which no job, plan, list or report is", file.string()));
        }
    }
}

std::string shownLine(const std::string& line) {
    constexpr std::size_t kMost = 80;
    return printable(std::string_view(line).substr(0, kMost)) + (line.size() > kMost ? " ..." : "");
}

}  // namespace abrdf
