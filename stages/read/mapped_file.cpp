// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace abrdf {

MappedFile::MappedFile(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    struct stat state {};
    bool works = descriptor >= 0 && fstat(descriptor, &state) == 0;
    if (works && state.st_size > 0) {
        size_ = static_cast<std::size_t>(state.st_size);
        void* place = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
        works = place != MAP_FAILED;
        if (works) data_ = static_cast<const char*>(place);
    }
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (works) return;
    throw std::runtime_error(
        fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(reason)));
}

MappedFile::~MappedFile() {
    if (data_ != nullptr) munmap(const_cast<char*>(data_), size_);
}

}  // namespace abrdf
