// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace abrdf {

/// The text of a job file, a plan, a list or a report. It may come from a pipe; at most 64 MB of it
/// are taken, so that no device or mistaken database fills the memory.
/// Throws std::runtime_error that names the file.
std::string textOfFile(const std::filesystem::path& file);

/// A line for a message: at most its first 80 bytes.
std::string shownLine(const std::string& line);

/// True for a table's line of names: its first word begins with a letter and is no number ("nan").
bool isLineOfNames(const std::string& line);

}  // namespace abrdf
