// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/mapped_file.h"

#include "abrdf/file_descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace abrdf {

/// Those that are open, for the handler of SIGBUS: it may neither lock nor allocate. More than
/// these go without it.
class MappedFiles {
  public:
    static void add(MappedFile* file) {
        static const bool handled = handleSigbus();
        static_cast<void>(handled);
        for (auto& place : gPlaces) {
            MappedFile* none = nullptr;
            if (place.compare_exchange_strong(none, file)) return;
        }
    }
    static void remove(MappedFile* file) {
        for (auto& place : gPlaces) {
            MappedFile* expected = file;
            if (place.compare_exchange_strong(expected, nullptr)) return;
        }
    }

  private:
    static bool handleSigbus() {
        struct sigaction action {};
        action.sa_sigaction = onSigbus;
        action.sa_flags = SA_SIGINFO;
        return sigaction(SIGBUS, &action, nullptr) == 0;
    }

    static void onSigbus(int, siginfo_t* info, void*) {
        const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
        const auto fault = reinterpret_cast<std::uintptr_t>(info->si_addr);
        for (const auto& place : gPlaces) {
            MappedFile* file = place.load();
            if (file == nullptr) continue;
            const auto begin = reinterpret_cast<std::uintptr_t>(file->data_);
            if (fault < begin || fault - begin >= file->size_) continue;
            file->isWhole_ = false;
            void* zeros = reinterpret_cast<void*>(fault / page * page);
            if (mmap(zeros, page, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) ==
                zeros)
                return;
        }
        std::signal(SIGBUS, SIG_DFL);  // None of ours: it is raised again, and ends the program.
    }

    static inline std::array<std::atomic<MappedFile*>, 64> gPlaces{};
};

MappedFile::MappedFile(const std::filesystem::path& path) : path_(path) {
    const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat state {};
    bool works = file.isOpen() && fstat(file.number(), &state) == 0;
    if (works && state.st_size > 0) {
        size_ = static_cast<std::size_t>(state.st_size);
        void* place = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number(), 0);
        works = place != MAP_FAILED;
        if (works) data_ = static_cast<const char*>(place);
    }
    if (works) {
        MappedFiles::add(this);
        return;
    }
    throw std::runtime_error(
        fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno)));
}

void MappedFile::checkWhole() const {
    if (isWhole_) return;
    throw std::runtime_error(fmt::format(
        "{}: cannot be read: it was cut meanwhile, or its disk fails; fetch it again and run again",
        path_.string()));
}

MappedFile::~MappedFile() {
    MappedFiles::remove(this);
    if (data_ != nullptr) munmap(const_cast<char*>(data_), size_);
}

}  // namespace abrdf
