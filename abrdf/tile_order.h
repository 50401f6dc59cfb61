// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_layout.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace abrdf {

/// Cells of a grid (texels, or pairs) in the order of an atlas's tiles: tile by tile in rows from
/// the top, within a tile row by row. Tiles at the right and the lower border may be smaller.
class TileOrder {
  public:
    struct Tile {
        int x = 0;  ///< Its first cell.
        int y = 0;
        int width = 0;  ///< Cells.
        int height = 0;
        std::size_t cells() const {
            return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        }
    };

    TileOrder() = default;
    /// width x height cells in tiles of tileWidth x tileHeight; all at least 1.
    TileOrder(int width, int height, int tileWidth, int tileHeight)
        : width_(width), height_(height), tileWidth_(tileWidth), tileHeight_(tileHeight) {}

    int width() const { return width_; }
    int height() const { return height_; }
    int tileWidth() const { return tileWidth_; }
    int tileHeight() const { return tileHeight_; }
    int tilesWide() const { return (width_ + tileWidth_ - 1) / tileWidth_; }
    int tilesHigh() const { return (height_ + tileHeight_ - 1) / tileHeight_; }
    std::size_t tiles() const {
        return static_cast<std::size_t>(tilesWide()) * static_cast<std::size_t>(tilesHigh());
    }
    std::size_t cells() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    Tile tile(std::size_t index) const;

    /// Place of a tile's first cell in this order; the number of cells for index = tiles().
    std::size_t firstCell(std::size_t index) const;

    /// True where this is the order of rows, from the top, as well.
    bool isRowOrder() const { return tileHeight_ == 1 || tileWidth_ >= width_; }

    /// ordered[place] = rows[y * width + x] for all cells. T: a value type.
    template <typename T>
    void reorder(std::span<const T> rows, std::span<T> ordered) const {
        forEachCell([&](std::size_t place, std::size_t inRows) { ordered[place] = rows[inRows]; });
    }

    /// The inverse: rows[y * width + x] = ordered[place].
    template <typename T>
    void restore(std::span<const T> ordered, std::span<T> rows) const {
        forEachCell([&](std::size_t place, std::size_t inRows) { rows[inRows] = ordered[place]; });
    }

  private:
    template <typename Visit>
    void forEachCell(const Visit& visit) const {
        std::size_t place = 0;
        for (std::size_t i = 0; i < tiles(); ++i) {
            const Tile t = tile(i);
            for (int y = t.y; y < t.y + t.height; ++y) {
                const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                   static_cast<std::size_t>(t.x);
                for (int x = 0; x < t.width; ++x) {
                    visit(place++, first + static_cast<std::size_t>(x));
                }
            }
        }
    }

    int width_ = 1;
    int height_ = 1;
    int tileWidth_ = 1;
    int tileHeight_ = 1;
};

/// How an atlas is cut: cells are texels in an angular one, pairs (views across, lights down) in a
/// spatial one; a tile holds whole cells and is at least 64 pixels wide and high.
TileOrder tileOrderOf(const AtlasLayout& layout);

/// The order in which an atlas's texels are made: that of an angular one's tiles, or of rows.
TileOrder texelOrderOf(const AtlasLayout& layout);

}  // namespace abrdf
