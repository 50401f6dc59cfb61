// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace abrdf {

/// Writes every file below `folder` into the new zip archive `zip`: stored, not deflated (images
/// do not shrink), in the order of their names, with a fixed date, so that the same files make the
/// same bytes. Memory does not grow with the files. Throws std::runtime_error, or Cancelled, and
/// leaves no archive then.
void zipFolder(const std::filesystem::path& folder, const std::filesystem::path& zip);

}  // namespace abrdf
