// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/file_descriptor.h"

#include <zip.h>

#include <cstdint>
#include <filesystem>
#include <memory>

namespace abrdf {

/// A file that is read at any place by any thread.
class SharedFile {
  public:
    /// Throws std::runtime_error that names the file.
    explicit SharedFile(const std::filesystem::path& path);

    std::uint64_t size() const { return size_; }

    /// Bytes read from `offset` on, fewer at the end; negative where the system fails.
    std::int64_t read(std::uint64_t offset, void* bytes, std::uint64_t count) const;

  private:
    FileDescriptor file_;
    std::uint64_t size_ = 0;
};

struct ZipCloser {
    void operator()(zip_t* archive) const { zip_discard(archive); }
};
using ZipHandle = std::unique_ptr<zip_t, ZipCloser>;

/// An archive for one thread at a time, over a file that many share. libzip's own way to a file
/// asks the system for its state once an entry: 10 ms for 6,561 images.
/// `file` must outlive the handle. Throws std::runtime_error with `name`.
ZipHandle openZip(const SharedFile& file, const std::filesystem::path& name);

}  // namespace abrdf
