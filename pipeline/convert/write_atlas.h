// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "abrdf/transposed_table.h"
#include "pipeline/convert/memory_plan.h"
#include "pipeline/convert/texel_maker.h"
#include "stages/write/atlas_writer.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace abrdf {

/// Some tiles more that an atlas holds.
struct TilesAdded {
    WrittenTiles written;    ///< All tiles so far.
    std::uint64_t hash = 0;  ///< contentHash() of the added tiles' chunks.
    UnrealCounts counts;     ///< Of the added tiles' values; clamped ones hold those cut to half.
    double seconds = 0;      ///< That writing them took.
    /// Of the added tiles' texels, in the order of cells. None where the method knows none, and
    /// none of a spatial atlas, whose texels are made anew by a run that goes on.
    std::vector<float> estimates = {};
};
using TilesSink = std::function<void(const TilesAdded& added)>;

/// Everything that turns a table of texels into the tiles of an atlas.
struct AtlasRun {
    const TransposedTable& texels;  ///< Rows images, columns texels in the order of the tiles.
    /// Makes cells [first, first + count) of the atlas, which lie in `band` from `inBand` on.
    std::function<void(std::span<const Rgb> band, std::size_t inBand, std::size_t first,
                       std::size_t count, TexelMaker::Buffers& texels)>
        make;
    std::size_t pairs;  ///< Of the atlas.
    AtlasLayout layout;
    MemoryPlan memory;
    PixelType type = PixelType::kHalf;
    bool endWhereCut = false;       ///< Stop at the first value that no half can hold.
    std::filesystem::path scratch;  ///< Folder of scratch files.
};

/// The last turn of a spatial atlas: from a table of pairs (rows texels, columns pairs in the order
/// of the tiles) into the tiles that `writer` lacks. counts: of all values, told with the last
/// tile.
struct ItemRun {
    AtlasLayout layout;
    MemoryPlan memory;
    PixelType type = PixelType::kHalf;
};
void writeItems(const ItemRun& run, const TransposedTable& items, const UnrealCounts& counts,
                AtlasWriter& writer, const TilesSink& told, const ProgressSink& progress);

/// Makes and appends all tiles that `writer` lacks, in one flow: a run of tiles is fetched, made
/// and encoded while the one before is written. Returns false where run.endWhereCut ended it.
bool writeTiles(const AtlasRun& run, AtlasWriter& writer, const TilesSink& told,
                const ProgressSink& progress);

}  // namespace abrdf
