// SPDX-License-Identifier: BSD-3-Clause
#include "stages/pack/pack_texels.h"

#include "abrdf/packed_lines.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace abrdf {

TexelFinisher::TexelFinisher(const AngularGrid& grid, PackOptions options)
    : options_(std::move(options)), views_(grid.views().size()) {
    if (!options_.divideCosine) return;
    const double leastCosine = std::cos(radiansFromDegrees(89.9));
    for (const Direction& light : grid.lights()) {
        factors_.push_back(static_cast<float>(1 / std::max(leastCosine, std::cos(light.theta))));
    }
}

void TexelFinisher::finish(std::span<Rgb> abrdfs) const {
    for (std::size_t line = 0; !factors_.empty() && line * views_ < abrdfs.size(); ++line) {
        const float factor = factors_[line % factors_.size()];
        for (Rgb& value : abrdfs.subspan(line * views_, views_)) value *= factor;
    }
    if (!options_.toOutputSpace.isIdentity()) options_.toOutputSpace.apply(abrdfs);
}

std::uint64_t packAngularTile(std::span<const Rgb> abrdfs, const AtlasLayout& layout,
                              const TileOrder::Tile& tile, PixelType type, std::span<char> packed) {
    const auto views = static_cast<std::size_t>(layout.views);
    const auto lights = static_cast<std::size_t>(layout.lights);
    const auto wide = static_cast<std::size_t>(tile.width);
    const std::size_t channel = wide * views * bytesOf(type);
    std::uint64_t cut = 0;
    for (std::size_t t = 0; t < tile.cells(); ++t) {
        char* begin =
            packed.data() + (t / wide) * lights * 3 * channel + (t % wide) * views * bytesOf(type);
        cut += packLines(abrdfs.data() + t * lights * views, lights, views, type,
                         {begin, channel, 3 * channel});
    }
    return cut;
}

std::uint64_t itemsFromTexels(std::span<const Rgb> abrdfs, const TileOrder& order, PixelType type,
                              std::span<char> items) {
    const std::size_t pairs = order.cells();
    std::vector<Rgb> ordered(order.isRowOrder() ? 0 : pairs);
    std::uint64_t cut = 0;
    const std::size_t itemBytes = 3 * bytesOf(type);
    std::vector<std::uint16_t> halfs(type == PixelType::kHalf ? 3 * pairs : 0);
    for (std::size_t t = 0; t * pairs < abrdfs.size(); ++t) {
        std::span<const Rgb> abrdf = abrdfs.subspan(t * pairs, pairs);
        if (!ordered.empty()) {
            order.reorder<Rgb>(abrdf, ordered);
            abrdf = ordered;
        }
        const void* values = abrdf.data();
        if (type == PixelType::kHalf) {
            cut += halfsFrom(abrdf.data(), pairs, halfs.data());
            values = halfs.data();
        }
        std::memcpy(items.data() + t * pairs * itemBytes, values, pairs * itemBytes);
    }
    return cut;
}

namespace {

template <typename Channel>
void packItems(std::span<const char> band, std::size_t first, const AtlasLayout& layout,
               const TileOrder::Tile& tile, std::span<char> packed) {
    constexpr std::size_t kItem = 3 * sizeof(Channel);
    const auto texelsWide = static_cast<std::size_t>(layout.texelsWide);
    const auto texelsHigh = static_cast<std::size_t>(layout.texelsHigh);
    const auto wide = static_cast<std::size_t>(tile.width);
    const std::size_t rowBytes = band.size() / layout.texelCount();
    const std::size_t channel = wide * texelsWide * sizeof(Channel);
    // A row of texels at a time, for all pairs of the tile: their items stand close together.
    for (std::size_t y = 0; y < texelsHigh; ++y) {
        for (std::size_t cell = 0; cell < tile.cells(); ++cell) {
            const char* in = band.data() + y * texelsWide * rowBytes + (first + cell) * kItem;
            char* out = packed.data() + ((cell / wide) * texelsHigh + y) * 3 * channel +
                        (cell % wide) * texelsWide * sizeof(Channel);
            for (std::size_t x = 0; x < texelsWide; ++x, in += rowBytes, out += sizeof(Channel)) {
                std::memcpy(out, in + 2 * sizeof(Channel), sizeof(Channel));
                std::memcpy(out + channel, in + sizeof(Channel), sizeof(Channel));
                std::memcpy(out + 2 * channel, in, sizeof(Channel));
            }
        }
    }
}

}  // namespace

void packSpatialTile(std::span<const char> band, std::size_t first, const AtlasLayout& layout,
                     const TileOrder::Tile& tile, PixelType type, std::span<char> packed) {
    if (type == PixelType::kHalf) {
        packItems<std::uint16_t>(band, first, layout, tile, packed);
    } else {
        packItems<float>(band, first, layout, tile, packed);
    }
}

}  // namespace abrdf
