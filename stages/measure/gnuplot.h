// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace abrdf {

/// Runs gnuplot on a script; what it prints on standard output becomes the file, whole or not at
/// all. Throws std::runtime_error where gnuplot is not installed or fails.
void runGnuplot(const std::string& script, const std::filesystem::path& output);

}  // namespace abrdf
