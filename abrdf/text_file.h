// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace abrdf {

/// The text of a job file, a plan, a list or a report. It may come from a pipe; at most 64 MB of it
/// are taken, so that no device or mistaken database fills the memory. A pipe that nobody writes
/// to is waited for.
/// Throws std::runtime_error that names the file; Cancelled.
std::string textOfFile(const std::filesystem::path& file);

/// A line for a message: at most its first 80 bytes, as printable() shows them.
std::string shownLine(const std::string& line);

}  // namespace abrdf
