// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/write_atlas.h"

#include "abrdf/content_hash.h"
#include "abrdf/flow.h"
#include "abrdf/stopwatch.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace abrdf {

namespace {

/// The bands that a flow is at: the present one, and the one before, of which runs are under way.
class Bands {
  public:
    Bands(const TransposedTable& table, std::size_t runsPerBand)
        : table_(table), runsPerBand_(runsPerBand) {}

    /// The band of a run; runs come in order, and no more of them are under way than a band has.
    std::span<const char> of(std::size_t run) {
        const std::size_t band = run / runsPerBand_;
        Held& held = held_[band % held_.size()];
        if (held.items.empty() || held.band != band) {
            held.band = band;
            held.items = table_.band(band, held.buffer);
        }
        return held.items;
    }

  private:
    struct Held {
        std::size_t band = 0;
        std::vector<char> buffer;
        std::span<const char> items;
    };

    const TransposedTable& table_;
    std::size_t runsPerBand_;
    std::array<Held, 2> held_;
};

std::span<const Rgb> colorsOf(std::span<const char> bytes) {
    return {reinterpret_cast<const Rgb*>(bytes.data()), bytes.size() / sizeof(Rgb)};
}

/// Tiles or texels [begin, end) of one run.
struct Range {
    std::size_t begin;
    std::size_t end;
};

Range rangeOf(std::size_t run, std::size_t size, std::size_t count) {
    return {run * size, std::min(count, (run + 1) * size)};
}

struct Slot {
    std::span<const char> band;
    TexelMaker::Buffers texels;
    std::vector<char> packed;
    std::vector<char> chunks;
    std::uint64_t hash = 0;
    std::uint64_t cut = 0;
};

/// Bytes of a packed tile.
std::size_t packedBytes(const AtlasWriter& writer, std::size_t tile, PixelType type) {
    return 3 * bytesOf(type) * static_cast<std::size_t>(writer.tileWidth(tile)) *
           static_cast<std::size_t>(writer.tileHeight(tile));
}

/// Seconds that it took.
double append(AtlasWriter& writer, std::size_t tiles, std::span<const char> chunks) {
    const Stopwatch time;
    writer.append(tiles, chunks);
    return time.seconds();
}

/// Texel by texel into tiles.
bool writeAngular(const AtlasRun& run, AtlasWriter& writer, const TilesSink& told,
                  const ProgressSink& progress) {
    const TileOrder& order = writer.order();
    const std::size_t size = run.memory.runTiles;
    const std::size_t done = writer.written().tiles;
    const std::size_t firstRun = done / size;  // Of which some tiles may be there already.
    Bands bands(run.texels, run.memory.runsPerBand);
    std::vector<Slot> slots(run.memory.slots);
    std::atomic<bool> ended = false;
    const auto tilesOf = [&](std::size_t item) {
        Range tiles = rangeOf(firstRun + item, size, order.tiles());
        tiles.begin = std::max(tiles.begin, done);
        return tiles;
    };
    Flow flow;
    flow.items = (order.tiles() + size - 1) / size - firstRun;
    flow.slots = run.memory.slots;
    flow.fetch = [&](std::size_t item, std::size_t s) {
        if (!ended) slots[s].band = bands.of(firstRun + item);
    };
    flow.work = [&](std::size_t item, std::size_t s) {
        if (ended) return;
        Slot& slot = slots[s];
        const Range tiles = tilesOf(item);
        const std::size_t first = order.firstCell(tiles.begin);
        const std::size_t band = (firstRun + item) / run.memory.runsPerBand;
        run.make(colorsOf(slot.band), first - run.texels.bandBegin(band), first,
                 order.firstCell(tiles.end) - first, slot.texels);
        slot.chunks.clear();
        slot.cut = 0;
        std::size_t texel = 0;
        for (std::size_t t = tiles.begin; t < tiles.end; ++t) {
            const TileOrder::Tile tile = order.tile(t);
            slot.packed.resize(packedBytes(writer, t, run.type));
            slot.cut += packAngularTile(std::span<const Rgb>(slot.texels.abrdfs)
                                            .subspan(texel * run.pairs, tile.cells() * run.pairs),
                                        run.layout, tile, run.type, slot.packed);
            writer.encode(t, slot.packed, slot.chunks);
            texel += tile.cells();
        }
        slot.hash = contentHash(slot.chunks);
        if (run.endWhereCut && slot.cut > 0) ended = true;
    };
    flow.deliver = [&](std::size_t item, std::size_t s) {
        if (ended) return;
        Slot& slot = slots[s];
        const Range tiles = tilesOf(item);
        const double seconds = append(writer, tiles.end - tiles.begin, slot.chunks);
        slot.texels.unreal.clamped += slot.cut;
        const std::vector<float>& estimates = slot.texels.estimates;
        writer.keepEstimates(order.firstCell(tiles.begin), estimates);
        if (told) told({writer.written(), slot.hash, slot.texels.unreal, seconds, estimates});
        if (progress) progress({"reconstruct", "tiles", tiles.end, order.tiles()});
    };
    runFlow(flow);
    return !ended;
}

/// Texel by texel into a table of pairs; their estimates go to the writer. Returns nothing where a
/// value was cut and should not be.
std::optional<UnrealCounts> fillItems(const AtlasRun& run, AtlasWriter& writer,
                                      TransposedTable& items, const ProgressSink& progress) {
    const TileOrder& order = writer.order();
    const std::size_t size = run.memory.runTiles;
    const std::size_t texels = run.layout.texelCount();
    Bands bands(run.texels, run.memory.runsPerBand);
    std::vector<Slot> slots(run.memory.slots);
    std::atomic<bool> ended = false;
    std::atomic<std::size_t> made = 0;
    UnrealCounts total;
    Flow flow;
    flow.items = (texels + size - 1) / size;
    flow.slots = run.memory.slots;
    flow.fetch = [&](std::size_t item, std::size_t s) { slots[s].band = bands.of(item); };
    flow.work = [&](std::size_t item, std::size_t s) {
        if (ended) return;
        Slot& slot = slots[s];
        const Range range = rangeOf(item, size, texels);
        const std::size_t band = item / run.memory.runsPerBand;
        run.make(colorsOf(slot.band), range.begin - run.texels.bandBegin(band), range.begin,
                 range.end - range.begin, slot.texels);
        slot.packed.resize((range.end - range.begin) * run.pairs * 3 * bytesOf(run.type));
        slot.cut = itemsFromTexels(slot.texels.abrdfs, order, run.type, slot.packed);
        if (run.endWhereCut && slot.cut > 0) ended = true;
        items.store(range.begin, slot.packed);
        if (progress) {
            progress({"reconstruct", "texels", made += range.end - range.begin, texels});
        }
    };
    flow.deliver = [&](std::size_t item, std::size_t s) {
        total += slots[s].texels.unreal;
        total.clamped += slots[s].cut;
        if (!ended) writer.keepEstimates(item * size, slots[s].texels.estimates);
    };
    runFlow(flow);
    if (ended) return {};
    return total;
}

}  // namespace

void writeItems(const ItemRun& run, const TransposedTable& items, const UnrealCounts& counts,
                AtlasWriter& writer, const TilesSink& told, const ProgressSink& progress) {
    const TileOrder& order = writer.order();
    const std::size_t size = run.memory.itemTiles;
    const std::size_t done = writer.written().tiles;
    const std::size_t firstRun = done / size;
    Bands bands(items, run.memory.itemRunsPerBand);
    std::vector<Slot> slots(run.memory.slots);
    const auto tilesOf = [&](std::size_t item) {
        Range tiles = rangeOf(firstRun + item, size, order.tiles());
        tiles.begin = std::max(tiles.begin, done);
        return tiles;
    };
    Flow flow;
    flow.items = (order.tiles() + size - 1) / size - firstRun;
    flow.slots = run.memory.slots;
    flow.fetch = [&](std::size_t item, std::size_t s) {
        slots[s].band = bands.of(firstRun + item);
    };
    flow.work = [&](std::size_t item, std::size_t s) {
        Slot& slot = slots[s];
        const Range tiles = tilesOf(item);
        const std::size_t begin = items.bandBegin((firstRun + item) / run.memory.itemRunsPerBand);
        slot.chunks.clear();
        for (std::size_t t = tiles.begin; t < tiles.end; ++t) {
            slot.packed.resize(packedBytes(writer, t, run.type));
            packSpatialTile(slot.band, order.firstCell(t) - begin, run.layout, order.tile(t),
                            run.type, slot.packed);
            writer.encode(t, slot.packed, slot.chunks);
        }
        slot.hash = contentHash(slot.chunks);
    };
    flow.deliver = [&](std::size_t item, std::size_t s) {
        const Range tiles = tilesOf(item);
        const double seconds = append(writer, tiles.end - tiles.begin, slots[s].chunks);
        // The texels' counts belong to all tiles together: told once, with the last.
        const bool last = tiles.end == order.tiles();
        if (told) told({writer.written(), slots[s].hash, last ? counts : UnrealCounts{}, seconds});
        if (progress) progress({"write", "tiles", tiles.end, order.tiles()});
    };
    runFlow(flow);
}

bool writeTiles(const AtlasRun& run, AtlasWriter& writer, const TilesSink& told,
                const ProgressSink& progress) {
    if (run.layout.kind == AtlasKind::kAngular) {
        return writeAngular(run, writer, told, progress);
    }
    const TileOrder& order = writer.order();
    std::optional<std::filesystem::path> scratch;
    if (!run.memory.itemsInMemory) scratch = run.scratch;
    TransposedTable items(run.layout.texelCount(), 3 * bytesOf(run.type),
                          bandBegins(order, run.memory.itemRunsPerBand * run.memory.itemTiles),
                          scratch);
    const auto counts = fillItems(run, writer, items, progress);
    if (!counts) return false;
    writeItems({run.layout, run.memory, run.type}, items, *counts, writer, told, progress);
    return true;
}

}  // namespace abrdf
