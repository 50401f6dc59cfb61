// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace abrdf {

/// Shards of one job into the atlas that a single run would have written, to the byte. One whole
/// atlas alone, which is what shard 1/1 is, is copied.
struct MergeOptions {
    std::vector<std::filesystem::path> shards;  ///< In any order.
    std::filesystem::path output;
    std::uint64_t memory = std::uint64_t{2} << 30;  ///< Bound on the resident set, bytes.
};

/// Returns a report. Throws std::runtime_error where the shards are not those of one job, some are
/// missing or two are the same part, saying which.
nlohmann::ordered_json merge(const MergeOptions& options, const ProgressSink& progress);

}  // namespace abrdf
