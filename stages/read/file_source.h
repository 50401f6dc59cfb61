// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/read_limits.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace abrdf {

/// The files of a folder or of a .zip, which is read without unpacking it to disk.
class FileSource {
  public:
    /// Throws std::runtime_error where `path` is neither a readable folder nor a zip.
    explicit FileSource(const std::filesystem::path& path, const ReadLimits& limits = {});

    /// These files below a folder, in their order; they need not exist.
    FileSource(std::filesystem::path folder, std::vector<std::string> names,
               const ReadLimits& limits = {});

    ~FileSource();
    FileSource(FileSource&&) noexcept;

    const std::filesystem::path& path() const { return path_; }

    const ReadLimits& limits() const { return limits_; }

    /// Paths of all regular files below, with '/' between folders, sorted.
    const std::vector<std::string>& names() const { return names_; }

    /// The whole file names()[index], within limits(); from any thread. Throws std::runtime_error
    /// that names it.
    std::vector<char> read(std::size_t index) const;

    /// Bytes of the file names()[index] as stored, without reading it.
    std::uint64_t sizeOf(std::size_t index) const;

    /// "ARCHIVE.zip: inner/name" or the file's path: for messages.
    std::string fullName(std::size_t index) const;

  private:
    struct Zip;

    std::filesystem::path path_;
    ReadLimits limits_;
    std::vector<std::string> names_;
    std::unique_ptr<Zip> zip_;
};

/// True for a file that begins as a zip archive does.
bool isZip(const std::filesystem::path& path);

}  // namespace abrdf
