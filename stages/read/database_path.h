// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/file_source.h"
#include "stages/read/read_options.h"

#include <filesystem>
#include <memory>
#include <string>

namespace abrdf {

/// What lies at a path, looked at once for all readers: they recognize a database by the names of
/// its files or by a file's first bytes.
struct DatabasePath {
    /// Throws std::runtime_error that names `path` where there is nothing or it cannot be read.
    explicit DatabasePath(std::filesystem::path path, ReadOptions options = {});

    std::filesystem::path path;
    ReadOptions options;
    std::shared_ptr<const FileSource> files;  ///< Of a folder or a .zip; else null.
    std::string head;                         ///< The first 4096 bytes of another file.
    std::uint64_t size = 0;                   ///< Of that file, bytes.

    /// The file's or folder's own name; U+FFFD for bytes that are no UTF-8.
    std::string name() const;
};

}  // namespace abrdf
