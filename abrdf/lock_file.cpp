// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/lock_file.h"

#include "abrdf/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace abrdf {

LockFile::LockFile(const std::filesystem::path& path) {
    while (true) {
        file_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file_ < 0) {
            throw std::runtime_error(
                fmt::format("{}: {}", path.string(), systemFault("cannot be created", errno)));
        }
        int held = 0;
        do {
            held = flock(file_, LOCK_EX | LOCK_NB);
        } while (held != 0 && errno == EINTR);
        const bool isOthers = held != 0 && errno == EWOULDBLOCK;
        if (held != 0 && !isOthers) {
            const int error = errno;
            close(file_);
            throw std::runtime_error(
                fmt::format("{}: {}", path.string(), systemFault("cannot be locked", error)));
        }
        // Its holder may have removed it between the two calls.
        struct stat opened {};
        struct stat named {};
        if (!isOthers && fstat(file_, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
            opened.st_ino == named.st_ino && opened.st_dev == named.st_dev) {
            return;
        }
        close(file_);
        file_ = -1;
        if (isOthers) return;
    }
}

LockFile::~LockFile() {
    if (file_ >= 0) close(file_);
}

}  // namespace abrdf
