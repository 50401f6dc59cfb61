// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "pipeline/convert/convert.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// One material of a batch.
struct BatchItem {
    std::string input;
    std::string output;
    std::vector<std::string> words;  ///< Arguments of `abrdf convert` that say all of it.
};

/// Many conversions. Each runs in a process of its own, so that none can take another with it, and
/// its memory is bounded as the kernel counts it.
struct BatchOptions {
    std::filesystem::path program;                  ///< This one.
    int threads = 1;                                ///< For all of them together.
    std::uint64_t memory = std::uint64_t{2} << 30;  ///< Likewise, bytes.
    bool keepGoing = false;                         ///< After a failure; else the rest is skipped.
    Shard shard;                                    ///< Of the materials: each count-th one.
    MessageSink warn;                               ///< What the conversions warn of.
};

/// Converts them, as many at once as threads and memory allow. Returns the summary:
/// "materials" (input, output, status done | kept | failed | skipped, seconds, error or report),
/// counts of each status and the time. Throws std::invalid_argument where two have one output.
nlohmann::ordered_json runBatch(const std::vector<BatchItem>& items, const BatchOptions& options,
                                const ProgressSink& progress);

/// The summary as a table.
std::string batchTable(const nlohmann::ordered_json& summary);

}  // namespace abrdf
