// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/page/page_content.h"

#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// Adds to a page what reports of other commands say, each recognised by its key "command":
///   evaluate  a row a result of the poster's table, and a point of the error-time chart
///   chart     points alone: "results": [{"method", "input", "samples", "delta_e",
///             "microseconds_per_abrdf"}]
///   stress    the stability matrix: "results": [{"case", "method", "breakdown"}]; a breakdown is a
///             number or a text, null where there is none
///   convert   a row of the table of atlases made
/// Returns the files that are JSON but no report of these. Throws std::runtime_error that names a
/// file which is no JSON, or lacks what its command promises.
std::vector<std::string> addReports(const std::vector<std::filesystem::path>& files,
                                    PageContent& content);

}  // namespace abrdf
