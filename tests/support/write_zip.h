// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace abrdf {

/// Writes all files below `folder` into the new archive `zip`; throws std::runtime_error.
void writeZip(const std::filesystem::path& zip, const std::filesystem::path& folder, bool deflate);

}  // namespace abrdf
