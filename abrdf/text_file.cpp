// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/text_file.h"

#include "abrdf/cancel.h"
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

class Descriptor {
  public:
    /// Not blocking, so that a pipe without a writer can be given up.
    explicit Descriptor(const std::filesystem::path& file)
        : number_(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        if (number_ >= 0) return;
        throw std::runtime_error(
            fmt::format("{}: cannot be opened: {}", file.string(), std::strerror(errno)));
    }
    ~Descriptor() { close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    /// As read(2), once there is something, or an end.
    ssize_t read(char* bytes, std::size_t count) const {
        constexpr int kPatience = 100;  // Milliseconds between looks for an interrupt.
        while (true) {
            throwIfCancelled();
            pollfd waited{number_, POLLIN, 0};
            if (poll(&waited, 1, kPatience) <= 0) continue;
            const ssize_t got = ::read(number_, bytes, count);
            if (got >= 0 || (errno != EINTR && errno != EAGAIN)) return got;
        }
    }

  private:
    int number_;
};

}  // namespace

std::string textOfFile(const std::filesystem::path& file) {
    constexpr std::size_t kMost = std::size_t{1} << 26;
    constexpr std::size_t kStep = std::size_t{1} << 16;
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw std::runtime_error(fmt::format("{}: is a folder, not a file", file.string()));
    }
    const Descriptor descriptor(file);
    std::string text;
    while (true) {
        const std::size_t before = text.size();
        text.resize(before + kStep);
        const ssize_t got = descriptor.read(text.data() + before, kStep);
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
