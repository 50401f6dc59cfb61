// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/scratch_file.h"

#include "abrdf/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace abrdf {

namespace fs = std::filesystem;

ScratchFile::ScratchFile(const fs::path& folder, std::uint64_t bytes) : folder_(folder) {
    std::error_code ignored;
    const fs::space_info space = fs::space(folder, ignored);
    if (!ignored && space.available < bytes) {
        throw std::runtime_error(fmt::format(
            "{}: has {:.1f} GB left, and this job needs {:.1f} GB there for what its memory does "
            "not hold; set TMPDIR to a folder with more, or give more --memory",
            folder.string(), static_cast<double>(space.available) / 1e9,
            static_cast<double>(bytes) / 1e9));
    }
    // Without a name, so that nothing stays whenever the process ends.
    file_ = FileDescriptor(open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    if (file_.isOpen()) return;
    std::string name = (folder / ".abrdf-scratch-XXXXXX").string();
    file_ = FileDescriptor(mkostemp(name.data(), O_CLOEXEC));
    if (!file_.isOpen()) fail("no scratch file can be made there");
    unlink(name.c_str());
}

void ScratchFile::fail(const char* what) const {
    throw std::runtime_error(fmt::format("{}: {}, or set TMPDIR to another folder",
                                         folder_.string(), systemFault(what, errno)));
}

void ScratchFile::write(std::uint64_t position, std::span<const char> bytes) {
    while (!bytes.empty()) {
        const ssize_t count =
            pwrite(file_.number(), bytes.data(), bytes.size(), static_cast<off_t>(position));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail("the scratch file there cannot be written");
        position += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

void ScratchFile::read(std::uint64_t position, std::span<char> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count =
            pread(file_.number(), bytes.data(), bytes.size(), static_cast<off_t>(position));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) fail("the scratch file there cannot be read");
        position += static_cast<std::uint64_t>(count);
        bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
}

fs::path scratchFolder(const fs::path& output) {
    if (const char* folder = std::getenv("TMPDIR"); folder != nullptr && *folder != '\0') {
        return folder;
    }
    return output.has_parent_path() ? output.parent_path() : ".";
}

}  // namespace abrdf
