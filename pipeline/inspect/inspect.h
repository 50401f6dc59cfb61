// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "stages/read/read_options.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace abrdf {

/// What a database or an atlas is, and what is missing, double or unreadable in it: every image of
/// a database is decoded. The report of interface.md; "complete" says whether nothing is wrong.
/// Throws std::runtime_error where `path` is neither.
nlohmann::ordered_json inspect(const std::filesystem::path& path, const ProgressSink& progress,
                               const ReadOptions& options = {});

/// Such a report as text: one line a fact, the first five of each kind of fault.
std::string textOf(const nlohmann::ordered_json& report);

}  // namespace abrdf
