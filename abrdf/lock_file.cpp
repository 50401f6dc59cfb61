// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/lock_file.h"

#include "abrdf/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

namespace abrdf {

LockFile::LockFile(const std::filesystem::path& path) {
    while (true) {
        FileDescriptor file(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
        if (!file.isOpen()) {
            throw std::runtime_error(
                fmt::format("{}: {}", path.string(), systemFault("cannot be created", errno)));
        }
        int held = 0;
        do {
            held = flock(file.number(), LOCK_EX | LOCK_NB);
        } while (held != 0 && errno == EINTR);
        if (held != 0 && errno == EWOULDBLOCK) return;  // Another process has it.
        if (held != 0) {
            throw std::runtime_error(
                fmt::format("{}: {}", path.string(), systemFault("cannot be locked", errno)));
        }
        // Its holder may have removed it between the two calls.
        struct stat opened {};
        struct stat named {};
        if (fstat(file.number(), &opened) == 0 && stat(path.c_str(), &named) == 0 &&
            opened.st_ino == named.st_ino && opened.st_dev == named.st_dev) {
            file_ = std::move(file);
            return;
        }
    }
}

}  // namespace abrdf
