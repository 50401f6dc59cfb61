// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace abrdf {

/// A file that appears whole or not at all: bytes go to a temporary beside `path`, commit() puts
/// it in place; destroyed without commit() the temporary is gone and an older file is intact. Where
/// the file system can, the temporary has no name until then: not even SIGKILL leaves one.
/// Every failure throws std::runtime_error with the path, the system's reason and what helps.
class OutputFile {
  public:
    explicit OutputFile(std::filesystem::path path);

    /// One that a later run may continue: its temporary is partialBeside(path), of which the first
    /// `keep` bytes stay; without commit() it stays as it is.
    struct Partial {
        std::uint64_t keep = 0;
    };
    OutputFile(std::filesystem::path path, Partial partial);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::span<const char> bytes);
    std::uint64_t position() const;
    void seek(std::uint64_t position);
    /// Hands what was written to the system: it stays though this process be killed.
    void flush();
    void commit();

    const std::filesystem::path& path() const { return path_; }

  private:
    [[noreturn]] void fail(const char* what) const;
    void putInPlace();

    std::filesystem::path path_;
    std::filesystem::path temporary_;
    std::FILE* file_ = nullptr;
    bool isPartial_ = false;
    bool isNameless_ = false;
};

/// Writes a whole small file through OutputFile.
void writeWholeFile(const std::filesystem::path& path, std::string_view bytes);

/// Throws where `path` cannot become an output file: its folder does not exist or takes no files,
/// or the path is a folder or a device. Asked before any work starts.
void checkOutputPath(const std::filesystem::path& path);

/// The same, and throws where what is there is what a job reads.
void checkOutputPath(const std::filesystem::path& path, const std::filesystem::path& input);

/// The temporary's name beside `path`: hidden, and different for each process.
std::filesystem::path temporaryBeside(const std::filesystem::path& path);

/// "cannot be written: No space left on device; free some space and run again": what failed, the
/// system's reason and what helps.
std::string systemFault(const char* what, int error);

/// The name of an unfinished output that may be continued: hidden, the same for each process.
std::filesystem::path partialBeside(const std::filesystem::path& path);

}  // namespace abrdf
