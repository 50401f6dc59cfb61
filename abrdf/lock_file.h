// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/file_descriptor.h"

#include <filesystem>

namespace abrdf {

/// A handle on the file `path`, made where it is absent, that no other process gets while it is
/// open. The lock goes with the process, however that ends.
class LockFile {
  public:
    /// Throws std::runtime_error where the file cannot be had; isHeld() tells whether another
    /// process has it.
    explicit LockFile(const std::filesystem::path& path);

    bool isHeld() const { return file_.isOpen(); }

  private:
    FileDescriptor file_;
};

}  // namespace abrdf
