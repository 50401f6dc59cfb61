// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_layout.h"
#include "abrdf/pixel_type.h"
#include "abrdf/tile_order.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// "2G", "500M", "65536K", or bytes; powers of 1024. Throws std::invalid_argument.
std::uint64_t bytesFromText(const std::string& text);

/// What a conversion asks of memory.
struct MemoryTask {
    AtlasLayout layout;
    PixelType type = PixelType::kHalf;
    std::size_t images = 0;         ///< Rows of the table of texels.
    std::size_t samples = 0;        ///< A texel.
    std::size_t reconstructed = 0;  ///< Pairs a texel as the method makes them.
    std::size_t texelsAtOnce = 32;  ///< As many as the method likes to do together.
    std::uint64_t imageBytes = 0;   ///< To decode and average one image.
    std::uint64_t fixedBytes = 0;   ///< The program, its libraries and the method's matrices.
    int threads = 1;
};

/// How a conversion keeps within its memory: what stays there, what goes to scratch files, and how
/// much is under way at once.
struct MemoryPlan {
    std::size_t readSlots = 1;  ///< Images under way.
    std::size_t slots = 1;      ///< Runs of tiles under way.
    std::size_t runTiles = 1;   ///< Tiles (angular) or texels (spatial) of a run.
    bool samplesInMemory = true;
    std::size_t runsPerBand = 0;  ///< Runs of a band of samples; all where they are in memory.
    // A spatial atlas is turned once more, from texels to pairs.
    bool itemsInMemory = true;
    std::size_t itemTiles = 1;  ///< Tiles of a run of pairs.
    std::size_t itemRunsPerBand = 0;
    std::uint64_t scratchBytes = 0;  ///< Of all scratch files.
    std::uint64_t peak = 0;          ///< Estimate of the resident set.
};

/// The fastest plan within `budget` bytes. Throws std::invalid_argument that names the smallest
/// budget that works.
MemoryPlan planMemory(const MemoryTask& task, std::uint64_t budget);

/// The runs [begin, end) of `run` out of `count`, and the first cell of each band in `order`.
std::vector<std::size_t> bandBegins(const TileOrder& order, std::size_t tilesPerBand);

}  // namespace abrdf
