// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <span>

namespace abrdf {

/// The bytes of a whole file, brought in by the system where they are looked at: a header that
/// declares more than there is allocates nothing. Where the system cannot bring them, as the file
/// was cut meanwhile or its disk fails, it raises SIGBUS: zeros stand in, and checkWhole() throws.
class MappedFile {
  public:
    /// Throws std::runtime_error that names the file.
    explicit MappedFile(const std::filesystem::path& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    std::span<const char> bytes() const { return {data_, size_}; }

    /// Throws std::runtime_error that names the file where some of its bytes could not be read.
    /// Asked after they were looked at.
    void checkWhole() const;

  private:
    friend class MappedFiles;

    std::filesystem::path path_;
    std::atomic<bool> isWhole_ = true;
    const char* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace abrdf
