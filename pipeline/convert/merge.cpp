// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/merge.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/convert/job_shards.h"
#include "pipeline/convert/write_atlas.h"
#include "pipeline/process_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// Tiles of angular atlases stand one below the other: their bytes are copied.
void appendTiles(const std::vector<AtlasTiles>& shards, AtlasWriter& writer,
                 const ProgressSink& progress) {
    for (const AtlasTiles& shard : shards) {
        for (std::size_t i = 0; i < shard.order().tiles(); ++i) {
            writer.appendData(shard.raw(i));
            if (progress) {
                progress({"merge", "tiles", writer.written().tiles, writer.order().tiles()});
            }
        }
    }
}

/// The texels of a tile, each with all its pairs, from the tile's pixels.
std::vector<Rgb> texelsOf(const std::vector<Rgb>& pixels, const TileOrder::Tile& tile,
                          const AtlasLayout& layout) {
    const auto views = static_cast<std::size_t>(layout.views);
    const auto lights = static_cast<std::size_t>(layout.lights);
    const auto wide = static_cast<std::size_t>(tile.width);
    std::vector<Rgb> texels(pixels.size());
    for (std::size_t line = 0; line < static_cast<std::size_t>(tile.height) * lights; ++line) {
        for (std::size_t x = 0; x < wide; ++x) {
            const auto from =
                pixels.begin() + static_cast<std::ptrdiff_t>((line * wide + x) * views);
            const std::size_t texel = line / lights * wide + x;
            std::copy_n(from, views, &texels[(texel * lights + line % lights) * views]);
        }
    }
    return texels;
}

/// Puts all texels of the shards into a table of pairs.
void fillItems(const std::vector<AtlasTiles>& shards, const TileOrder& order, PixelType type,
               TransposedTable& items, const ProgressSink& progress) {
    std::size_t rowsBefore = 0;
    std::size_t done = 0;
    for (const AtlasTiles& shard : shards) {
        const AtlasLayout& layout = shard.header().layout;
        for (std::size_t i = 0; i < shard.order().tiles(); ++i) {
            const TileOrder::Tile tile = shard.order().tile(i);
            const std::vector<Rgb> texels = texelsOf(shard.pixels(i), tile, layout);
            std::vector<char> packed(texels.size() * 3 * bytesOf(type));
            itemsFromTexels(texels, order, type, packed);
            const std::size_t rowBytes = packed.size() / static_cast<std::size_t>(tile.height);
            for (int y = 0; y < tile.height; ++y) {
                const std::size_t row = rowsBefore + static_cast<std::size_t>(tile.y + y);
                items.store(
                    row * static_cast<std::size_t>(layout.texelsWide) +
                        static_cast<std::size_t>(tile.x),
                    std::span(packed).subspan(static_cast<std::size_t>(y) * rowBytes, rowBytes));
            }
            done += tile.cells();
            if (progress) progress({"merge", "texels", done, items.rows()});
        }
        rowsBefore += static_cast<std::size_t>(layout.texelsHigh);
    }
}

/// A spatial atlas holds a map a pair: the texels are turned once more.
void turnTiles(const std::vector<AtlasTiles>& shards, const MergeOptions& options,
               AtlasWriter& writer, const AtlasLayout& layout, const ProgressSink& progress) {
    MemoryTask task;
    task.layout = layout;
    task.type = shards[0].type();
    task.fixedBytes = residentMemory();
    task.threads = threadsInUse();
    const MemoryPlan memory = planMemory(task, options.memory);
    std::optional<fs::path> scratch;
    if (!memory.itemsInMemory) scratch = scratchFolder(options.output);
    TransposedTable items(layout.texelCount(), 3 * bytesOf(task.type),
                          bandBegins(writer.order(), memory.itemRunsPerBand * memory.itemTiles),
                          scratch);
    fillItems(shards, writer.order(), task.type, items, progress);
    writeItems({layout, memory, task.type}, items, {}, writer, {}, progress);
}

/// The only part of a job is its atlas.
std::uint64_t copyWhole(const fs::path& from, const fs::path& to) {
    std::ifstream stream(from, std::ios::binary);
    OutputFile file(to);
    std::vector<char> piece(std::size_t{4} << 20);
    std::uint64_t bytes = 0;
    while (stream) {
        stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        const auto count = static_cast<std::size_t>(stream.gcount());
        file.write(std::span(piece).first(count));
        bytes += count;
    }
    if (!stream.eof() || bytes != fs::file_size(from)) {
        throw std::runtime_error(
            fmt::format("{}: cannot be read: {}", from.string(), std::strerror(errno)));
    }
    file.commit();
    return bytes;
}

ordered_json reportOf(const MergeOptions& options, const AtlasHeader& header, PixelType type,
                      const std::vector<float>& estimates, std::uint64_t bytes,
                      const Stopwatch& time) {
    ordered_json report = {{"command", "merge"},
                           {"version", ABRDF_VERSION},
                           {"shards", options.shards.size()},
                           {"texels", {header.layout.texelsWide, header.layout.texelsHigh}},
                           {"counts",
                            {{"clamped", header.counts.clamped},
                             {"extrapolated", header.counts.extrapolated},
                             {"nonfinite", header.counts.nonfinite}}}};
    addEstimate(estimates, report);
    report["time"] = {{"total", time.seconds()}};
    report["peak_memory"] = peakMemory();
    report["output"] = {
        {"path", options.output.string()}, {"bytes", bytes}, {"pixel", nameOf(type)}};
    return report;
}

}  // namespace

ordered_json merge(const MergeOptions& options, const ProgressSink& progress) {
    const Stopwatch time;
    checkOutputPath(options.output);
    if (options.shards.size() == 1) {
        const AtlasTiles atlas(options.shards[0]);
        if (atlas.header().shard == 0) {
            const std::uint64_t bytes = copyWhole(options.shards[0], options.output);
            return reportOf(options, atlas.header(), atlas.type(), atlas.estimates(), bytes, time);
        }
    }
    const auto [shards, job, header, estimates] = openShards(options.shards);
    AtlasWriter writer(options.output, header,
                       {shards[0].type(),
                        compressionFromName(job["compression"].get<std::string>()),
                        false,
                        {},
                        !estimates.empty()});
    std::vector<float> ordered(estimates.size());
    if (!ordered.empty()) texelOrderOf(header.layout).reorder<float>(estimates, ordered);
    writer.keepEstimates(0, ordered);
    if (header.layout.kind == AtlasKind::kAngular) {
        appendTiles(shards, writer, progress);
    } else {
        turnTiles(shards, options, writer, header.layout, progress);
    }
    const std::uint64_t bytes = writer.finish(header.counts);
    return reportOf(options, header, shards[0].type(), estimates, bytes, time);
}

}  // namespace abrdf
