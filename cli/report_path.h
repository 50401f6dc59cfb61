// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// Throws where --report cannot be written, as checkOutputPath(), and std::invalid_argument where
/// it names a file that the command's words name for something else, as its input or its output.
void checkReportPath(const std::filesystem::path& report, const std::vector<std::string>& words);

}  // namespace abrdf
