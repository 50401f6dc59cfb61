// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/pixel_type.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abrdf {

enum class Compression { kNone, kZips, kZip, kPiz };

/// none | zips | zip | piz; throws std::invalid_argument for other names.
Compression compressionFromName(const std::string& name);
std::string nameOf(Compression compression);

/// Makes OpenEXR's chunks of packed tiles, from any thread. OpenEXR's own files compress on its
/// own threads or on none; its core library, underneath, does it where it is called.
class TileEncoder {
  public:
    /// width, height: of the image; tileWidth, tileHeight: of its tiles. Pixels. part: the number
    /// of the image in a file of several; nothing where it is alone.
    TileEncoder(int width, int height, int tileWidth, int tileHeight, PixelType type,
                Compression compression, std::optional<int> part = {});
    ~TileEncoder();

    /// Appends the chunk of tile (tileX, tileY).
    /// packed: the tile as packLines() leaves it, clipped at the image's borders.
    void encode(int tileX, int tileY, std::span<const char> packed,
                std::vector<char>& chunks) const;

  private:
    struct Core;
    std::optional<int> part_;
    std::unique_ptr<Core> core_;  ///< Nothing where chunks are not compressed.
};

}  // namespace abrdf
