// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/pixel_type.h"
#include "abrdf/tile_order.h"
#include "color/rgb.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace abrdf {

/// An atlas that is open, to be taken tile by tile: one larger than memory can be.
/// Every failure throws std::runtime_error that names the file.
class AtlasTiles {
  public:
    explicit AtlasTiles(const std::filesystem::path& path);
    ~AtlasTiles();
    AtlasTiles(AtlasTiles&&) noexcept;
    AtlasTiles(const AtlasTiles&) = delete;
    AtlasTiles& operator=(const AtlasTiles&) = delete;
    AtlasTiles& operator=(AtlasTiles&&) = delete;

    const AtlasHeader& header() const;
    PixelType type() const;

    /// Tiles as tileOrderOf() counts them.
    const TileOrder& order() const;

    /// The data of a tile as the file holds them, compressed.
    std::vector<char> raw(std::size_t index) const;

    /// All pixels of a tile, row by row.
    std::vector<Rgb> pixels(std::size_t index) const;

    /// As readEstimates().
    std::vector<float> estimates() const;

  private:
    struct File;
    std::unique_ptr<File> file_;
};

}  // namespace abrdf
