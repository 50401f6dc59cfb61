// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace abrdf {

void writeFile(const std::filesystem::path& path, const std::string& bytes);

/// What opening a database and reading some of its images says; empty where nothing is wrong.
std::string readFault(const std::filesystem::path& path);

/// Cuts the bytes at some fifty places: each time reading must fail with a sentence that names the
/// file. A doctest check.
void checkEveryCut(const std::filesystem::path& path, const std::string& bytes);

}  // namespace abrdf
