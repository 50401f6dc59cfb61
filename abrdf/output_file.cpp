// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/output_file.h"

#include "abrdf/file_descriptor.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

fs::path folderOf(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

/// By which an open file can be given a name.
std::string linkOf(int file) {
    return fmt::format("/proc/self/fd/{}", file);
}

/// A file without a name in `folder`; none where the file system has none, or where it could not
/// be given one.
FileDescriptor openNameless(const fs::path& folder) {
    FileDescriptor file(open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666));
    if (file.isOpen() && access(linkOf(file.number()).c_str(), F_OK) != 0) return {};
    return file;
}

/// The same file as a stream; null where there is no memory for one.
std::FILE* streamOf(FileDescriptor file, const char* mode) {
    std::FILE* stream = fdopen(file.number(), mode);
    if (stream != nullptr) file.release();
    return stream;
}

}  // namespace

OutputFile::OutputFile(fs::path path) : path_(std::move(path)), temporary_(temporaryBeside(path_)) {
    FileDescriptor file = openNameless(folderOf(path_));
    isNameless_ = file.isOpen();
    file_ = isNameless_ ? streamOf(std::move(file), "wb") : std::fopen(temporary_.c_str(), "wbe");
    if (file_ == nullptr) fail("cannot be created");
}

OutputFile::OutputFile(fs::path path, Partial partial)
    : path_(std::move(path)), temporary_(partialBeside(path_)), isPartial_(true) {
    FileDescriptor file(open(temporary_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (!file.isOpen()) fail("cannot be created");
    if (ftruncate(file.number(), static_cast<off_t>(partial.keep)) != 0) fail("cannot be written");
    file_ = streamOf(std::move(file), "r+b");
    if (file_ == nullptr) fail("cannot be created");
}

OutputFile::~OutputFile() {
    if (!temporary_.empty() && !isPartial_ && !isNameless_) {
        std::error_code ignored;
        fs::remove(temporary_, ignored);
    }
    if (file_ != nullptr) std::fclose(file_);
}

void OutputFile::fail(const char* what) const {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), systemFault(what, errno)));
}

void OutputFile::putInPlace() {
    if (!isNameless_) {
        if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be put in place");
        return;
    }
    // Only a name can replace a name. This one is the same for all processes: what a killed one
    // left goes, and where another one was faster, this one's file gets the name again.
    const fs::path whole =
        path_.parent_path() / fmt::format(".{}.abrdf-whole", path_.filename().string());
    const std::string link = linkOf(fileno(file_));
    while (true) {
        if (linkat(AT_FDCWD, link.c_str(), AT_FDCWD, whole.c_str(), AT_SYMLINK_FOLLOW) != 0) {
            const bool isThere = errno == EEXIST;
            if (!isThere || (unlink(whole.c_str()) != 0 && errno != ENOENT))
                fail("cannot be put in place");
            continue;
        }
        if (std::rename(whole.c_str(), path_.c_str()) == 0) return;
        const int error = errno;
        if (error == ENOENT) continue;
        unlink(whole.c_str());
        errno = error;
        fail("cannot be put in place");
    }
}

void OutputFile::write(std::span<const char> bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
        fail("cannot be written");
}

std::uint64_t OutputFile::position() const {
    return static_cast<std::uint64_t>(ftello(file_));
}

void OutputFile::seek(std::uint64_t position) {
    if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail("cannot be written");
}

void OutputFile::flush() {
    if (std::fflush(file_) != 0) fail("cannot be written");
}

void OutputFile::commit() {
    // A full disk may show itself only here.
    if (std::ferror(file_) != 0 || std::fflush(file_) != 0 || fsync(fileno(file_)) != 0)
        fail("cannot be written");
    putInPlace();
    temporary_.clear();
    std::FILE* file = file_;
    file_ = nullptr;
    if (std::fclose(file) != 0) fail("cannot be written");
}

void writeWholeFile(const fs::path& path, std::string_view bytes) {
    OutputFile file(path);
    file.write(bytes);
    file.commit();
}

void checkOutputPath(const fs::path& path) {
    if (path.empty() || !path.has_filename()) {
        throw std::runtime_error(fmt::format("'{}' is no file name for an output", path.string()));
    }
    const fs::path folder = folderOf(path);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error && status.type() == fs::file_type::none) {
        throw std::runtime_error(
            fmt::format("{}: cannot be an output: {}", path.string(), error.message()));
    }
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(fmt::format("{}: the folder {} does not exist; make it first",
                                             path.string(), folder.string()));
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        throw std::runtime_error(fmt::format(
            "{}: is a folder or a device, not a file that can be replaced", path.string()));
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw std::runtime_error(fmt::format("{}: the folder {} cannot be written to: {}",
                                             path.string(), folder.string(), std::strerror(errno)));
    }
}

void checkOutputPath(const fs::path& path, const fs::path& input) {
    checkOutputPath(path);
    std::error_code ignored;
    if (!fs::exists(path, ignored) || !fs::equivalent(path, input, ignored)) return;
    throw std::runtime_error(
        fmt::format("{}: is the input as well; choose another output", path.string()));
}

std::string systemFault(const char* what, int error) {
    const char* help = "see to it and run again";
    if (error == ENOSPC || error == EDQUOT) help = "free some space and run again";
    if (error == EFBIG) help = "raise the limit on the size of files (ulimit -f) and run again";
    return fmt::format("{}: {}; {}", what, std::strerror(error), help);
}

fs::path temporaryBeside(const fs::path& path) {
    return path.parent_path() / fmt::format(".{}.abrdf-{}", path.filename().string(), getpid());
}

fs::path partialBeside(const fs::path& path) {
    return path.parent_path() / fmt::format(".{}.abrdf-partial", path.filename().string());
}

}  // namespace abrdf
