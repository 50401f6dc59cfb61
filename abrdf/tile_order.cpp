// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/tile_order.h"

#include <algorithm>

namespace abrdf {

TileOrder::Tile TileOrder::tile(std::size_t index) const {
    const auto wide = static_cast<std::size_t>(tilesWide());
    Tile tile;
    tile.x = static_cast<int>(index % wide) * tileWidth_;
    tile.y = static_cast<int>(index / wide) * tileHeight_;
    tile.width = std::min(tileWidth_, width_ - tile.x);
    tile.height = std::min(tileHeight_, height_ - tile.y);
    return tile;
}

std::size_t TileOrder::firstCell(std::size_t index) const {
    if (index >= tiles()) return cells();
    const Tile t = tile(index);
    return static_cast<std::size_t>(t.y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(t.x) * static_cast<std::size_t>(t.height);
}

TileOrder tileOrderOf(const AtlasLayout& layout) {
    constexpr int kLeast = 64;
    const auto cellsFor = [](int size) { return (kLeast - 1 + size) / size; };
    if (layout.kind == AtlasKind::kAngular) {
        return {layout.texelsWide, layout.texelsHigh, cellsFor(layout.views),
                cellsFor(layout.lights)};
    }
    return {layout.views, layout.lights, cellsFor(layout.texelsWide), cellsFor(layout.texelsHigh)};
}

TileOrder texelOrderOf(const AtlasLayout& layout) {
    if (layout.kind == AtlasKind::kAngular) return tileOrderOf(layout);
    return {layout.texelsWide, layout.texelsHigh, 1, 1};
}

}  // namespace abrdf
