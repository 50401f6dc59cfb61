// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/report/page_job.h"

namespace abrdf {

/// The page of a folder: all its atlases (.exr) and reports (.json), in the order of their names;
/// other files are passed over. `options.atlases` and `options.reports` are filled from it.
/// Throws as writePage(), and std::runtime_error where the folder has neither.
nlohmann::ordered_json reportFolder(const std::filesystem::path& folder, PageOptions options,
                                    const ProgressSink& progress);

}  // namespace abrdf
