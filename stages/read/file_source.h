// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
    explicit FileSource(const std::filesystem::path& path);

    /// These files below a folder, in their order; they need not exist.
    FileSource(std::filesystem::path folder, std::vector<std::string> names);

    ~FileSource();
    FileSource(FileSource&&) noexcept;

    const std::filesystem::path& path() const { return path_; }

    /// Paths of all regular files below, with '/' between folders, sorted.
    const std::vector<std::string>& names() const { return names_; }

    /// The whole file names()[index]; from any thread. Throws std::runtime_error that names it.
    std::vector<char> read(std::size_t index) const;

    /// Bytes of the file names()[index] as stored, without reading it.
    std::uint64_t sizeOf(std::size_t index) const;

    /// "ARCHIVE.zip: inner/name" or the file's path: for messages.
    std::string fullName(std::size_t index) const;

  private:
    struct Zip;

    std::filesystem::path path_;
    std::vector<std::string> names_;
    std::unique_ptr<Zip> zip_;
};

/// True for a file that begins as a zip archive does.
bool isZip(const std::filesystem::path& path);

}  // namespace abrdf
