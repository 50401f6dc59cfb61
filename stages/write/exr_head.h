// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/pixel_type.h"
#include "stages/write/tile_encoder.h"

#include <string>

namespace abrdf {

/// The first bytes of an atlas's file: OpenEXR's magic number, version and header, up to the table
/// of its tiles' places. With an estimate the headers of two parts, `rgb` and `estimate`: of the
/// latter all pixels are one tile.
class ExrHead {
  public:
    /// tileWidth, tileHeight: pixels.
    ExrHead(const AtlasHeader& atlas, PixelType type, Compression compression, int tileWidth,
            int tileHeight, bool hasEstimate);

    const std::string& bytes() const { return bytes_; }

    /// The same with other counts: they are known last, but headers come first.
    std::string withCounts(const ValueCounts& counts) const;

  private:
    std::string bytes_;
};

}  // namespace abrdf
