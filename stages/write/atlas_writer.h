// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/pixel_type.h"
#include "abrdf/tile_order.h"
#include "color/rgb.h"
#include "stages/write/tile_encoder.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

namespace abrdf {

/// True where every value keeps finite as a half (at most 65504).
bool fitsHalf(std::span<const Rgb> values);

/// How far an atlas was written: its first `tiles` tiles, which end at byte `end` of the file.
struct WrittenTiles {
    std::size_t tiles = 0;
    std::uint64_t end = 0;
};

struct AtlasWriterOptions {
    PixelType type = PixelType::kHalf;
    Compression compression = Compression::kZip;
    /// The unfinished file is partialBeside(path), which holds `written` already, and stays without
    /// finish(): a later run may continue it.
    bool resumable = false;
    WrittenTiles written;
    bool hasEstimate = false;  ///< Does the file have a part of estimates?
};

/// Writes an atlas as a tiled OpenEXR file: R, G, B in part 0; with estimates these are channel
/// `deltaE` of part 1, one pixel a texel. Tiles are cut and ordered as
/// tileOrderOf() says. They are encoded on any thread and appended in order, so that the file needs
/// no memory but that of the tiles under way. It appears under its name at finish() alone.
/// The same values give the same bytes. Throws std::runtime_error that names the file.
class AtlasWriter {
  public:
    AtlasWriter(const std::filesystem::path& path, const AtlasHeader& header,
                const AtlasWriterOptions& options);
    ~AtlasWriter();

    const TileOrder& order() const { return order_; }

    /// Pixels of tile `index`.
    int tileWidth(std::size_t index) const { return order_.tile(index).width * cellWidth_; }
    int tileHeight(std::size_t index) const { return order_.tile(index).height * cellHeight_; }

    /// Appends the chunk of a packed tile to `chunks`; from any thread.
    void encode(std::size_t index, std::span<const char> packed, std::vector<char>& chunks) const;

    /// Writes the chunks of the next `count` tiles, and hands them to the system.
    void append(std::size_t count, std::span<const char> chunks);

    /// Writes the next tile, whose data are those of a file with the same tiles.
    void appendData(std::span<const char> data);

    /// What was appended so far.
    WrittenTiles written() const;

    /// All rows of pixels from firstRow on that `pixels` holds, over the whole width: packs,
    /// encodes and appends their tiles. Whole rows of tiles, in ascending order. Returns how many
    /// values past the range of halfs were cut.
    std::uint64_t writeRows(int firstRow, int rows, std::span<const Rgb> pixels);

    /// Takes the estimated Delta E of texels, in the order of texelOrderOf(), from the texel
    /// `first` on. Those that are never told are NaN.
    void keepEstimates(std::size_t first, std::span<const float> deltaE);

    /// What was told so far, of all texels, row by row from the top; empty without estimates.
    std::vector<float> estimates() const;

    /// Puts the final counts into the header and the file in its place. Returns its size in bytes.
    std::uint64_t finish(const ValueCounts& counts);

  private:
    struct File;

    void appendEstimates();

    TileOrder order_;
    TileOrder texelOrder_;
    int cellWidth_;
    int cellHeight_;
    PixelType type_;
    bool hasEstimate_;
    std::vector<float> estimates_;  ///< In the texels' order.
    TileEncoder encoder_;
    std::unique_ptr<File> file_;
};

}  // namespace abrdf
