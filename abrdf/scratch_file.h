// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/file_descriptor.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace abrdf {

/// A file without a name for what memory does not hold: gone with the object, and with the process
/// however that ends. Every failure throws std::runtime_error with the folder and the system's
/// reason.
class ScratchFile {
  public:
    /// bytes: its size to come; throws at once where the folder's disk has not that much left.
    ScratchFile(const std::filesystem::path& folder, std::uint64_t bytes);

    // From any thread.
    void write(std::uint64_t position, std::span<const char> bytes);
    void read(std::uint64_t position, std::span<char> bytes) const;

  private:
    [[noreturn]] void fail(const char* what) const;

    std::filesystem::path folder_;
    FileDescriptor file_;
};

/// $TMPDIR where that is set, else the folder of `output`.
std::filesystem::path scratchFolder(const std::filesystem::path& output);

}  // namespace abrdf
