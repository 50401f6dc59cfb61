// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/atlas_layout.h"
#include "abrdf/pixel_type.h"
#include "abrdf/tile_order.h"
#include "color/color_config.h"
#include "color/rgb.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

struct PackOptions {
    ColorTransform toOutputSpace;  ///< From scene_linear to the atlas's colour space.
    bool divideCosine = false;     ///< Divide by cos(theta_i); at least cos(89.9 degrees).
};

/// Makes the final values of texels: cosine and colour space. Built once a job, then used from any
/// thread.
class TexelFinisher {
  public:
    TexelFinisher(const AngularGrid& grid, PackOptions options);

    /// In place; abrdfs: all pairs of the grid, texel after texel.
    void finish(std::span<Rgb> abrdfs) const;

  private:
    PackOptions options_;
    std::vector<float> factors_;  ///< Of each light; empty where the cosine stays.
    std::size_t views_;
};

/// Packs a tile of an angular atlas as OpenEXR stores it. abrdfs: all pairs of its texels, texel
/// after texel in the tile's order. packed: 3 channels of the tile's pixels.
/// Returns how many values past the range of halfs were cut.
std::uint64_t packAngularTile(std::span<const Rgb> abrdfs, const AtlasLayout& layout,
                              const TileOrder::Tile& tile, PixelType type, std::span<char> packed);

/// The values of a spatial atlas before they are packed: of each texel its pairs in the order of
/// the atlas's tiles, 3 channels each, as halfs or floats. items: for all texels of abrdfs.
/// Returns how many values past the range of halfs were cut.
std::uint64_t itemsFromTexels(std::span<const Rgb> abrdfs, const TileOrder& order, PixelType type,
                              std::span<char> items);

/// Packs a tile of a spatial atlas. band: of each texel the items of the same pairs, texel after
/// texel; the tile's are those from `first` on.
void packSpatialTile(std::span<const char> band, std::size_t first, const AtlasLayout& layout,
                     const TileOrder::Tile& tile, PixelType type, std::span<char> packed);

}  // namespace abrdf
