// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "stages/read/atlas_tiles.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <vector>

namespace abrdf {

/// The shards of one job, open, and the atlas that they are the parts of.
struct JobShards {
    std::vector<AtlasTiles> parts;  ///< In their order, none missing.
    nlohmann::ordered_json job;     ///< As identityOf(); has "layout", "texels" and "compression".
    AtlasHeader header;             ///< Of the whole atlas.
    std::vector<float> estimates;   ///< Of all texels, row by row; none where the shards have none.
};

/// Throws std::runtime_error where a file is no shard, the shards are not those of one job, some
/// are missing or two are the same part, saying which.
JobShards openShards(const std::vector<std::filesystem::path>& paths);

}  // namespace abrdf
