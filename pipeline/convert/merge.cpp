// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/merge.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/convert/tile_journal.h"
#include "pipeline/convert/write_atlas.h"
#include "pipeline/job.h"
#include "pipeline/process_memory.h"
#include "stages/read/atlas_tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

ordered_json jobOf(const AtlasTiles& shard, const fs::path& path) {
    ordered_json job = ordered_json::parse(shard.header().job, nullptr, false);
    if (shard.header().shard == 0) {
        throw std::runtime_error(fmt::format(
            "{}: is a whole atlas and no part of one; give only what one convert --shard I/N made",
            path.string()));
    }
    if (!job.is_object() || shard.header().layout.kind != AtlasKind::kAngular) {
        throw std::runtime_error(fmt::format(
            "{}: is no shard of an atlas; those are made by convert --shard I/N", path.string()));
    }
    for (const char* key : {"layout", "texels", "compression"}) {
        if (job.contains(key) && job[key].is_string()) continue;
        throw std::runtime_error(
            fmt::format("{}: has a damaged header: its job lacks its {}", path.string(), key));
    }
    return job;
}

/// What all shards of a job have alike, whatever its text says.
std::string formOf(const AtlasLayout& layout) {
    return fmt::format("texels {} wide of {} x {} directions", layout.texelsWide, layout.lights,
                       layout.views);
}

/// Throws where a shard is of another job than the first, or of another division of it.
void checkOneJob(const std::vector<AtlasTiles>& shards, const std::vector<fs::path>& paths) {
    const ordered_json job = jobOf(shards[0], paths[0]);
    for (std::size_t i = 1; i < shards.size(); ++i) {
        std::string changed = differences(job, jobOf(shards[i], paths[i]));
        if (shards[i].header().shards != shards[0].header().shards) {
            changed = fmt::format("one is of {} parts, the other of {}", shards[0].header().shards,
                                  shards[i].header().shards);
        } else if (changed.empty() &&
                   shards[i].estimates().empty() != shards[0].estimates().empty()) {
            changed =
                "one tells the error of its texels, the other does not; convert all parts with one "
                "version of abrdf";
        } else if (changed.empty() && shards[i].type() != shards[0].type()) {
            changed = fmt::format(
                "pixels were {} and are {}, as a value in one part fits no half; convert all parts "
                "with --pixel float, or with half",
                nameOf(shards[0].type()), nameOf(shards[i].type()));
        }
        const std::string form = formOf(shards[i].header().layout);
        if (changed.empty() && form != formOf(shards[0].header().layout)) {
            changed = fmt::format("{} instead of {}", form, formOf(shards[0].header().layout));
        }
        if (changed.empty()) continue;
        throw std::runtime_error(fmt::format("{}: is not of the job of {}: {}", paths[i].string(),
                                             paths[0].string(), changed));
    }
}

/// The shards in order of their parts. Throws where one is missing or there twice.
std::vector<AtlasTiles> openShards(const std::vector<fs::path>& paths) {
    std::vector<AtlasTiles> shards;
    for (const fs::path& path : paths) shards.emplace_back(path);
    checkOneJob(shards, paths);
    const auto count = static_cast<std::size_t>(shards[0].header().shards);
    std::vector<std::size_t> partAt(count, shards.size());
    for (std::size_t i = 0; i < shards.size(); ++i) {
        std::size_t& at = partAt[static_cast<std::size_t>(shards[i].header().shard - 1)];
        if (at < shards.size()) {
            throw std::runtime_error(fmt::format("{} and {} are both part {} of {}",
                                                 paths[at].string(), paths[i].string(),
                                                 shards[i].header().shard, count));
        }
        at = i;
    }
    std::string missing;
    std::vector<AtlasTiles> ordered;
    for (std::size_t part = 0; part < count; ++part) {
        if (partAt[part] == shards.size()) {
            missing += fmt::format("{}{}", missing.empty() ? "" : ", ", part + 1);
        } else {
            ordered.push_back(std::move(shards[partAt[part]]));
        }
    }
    if (!missing.empty()) {
        throw std::runtime_error(fmt::format("{}: of the {} parts of its job these are missing: {}",
                                             paths[0].string(), count, missing));
    }
    return ordered;
}

AtlasHeader wholeHeader(const std::vector<AtlasTiles>& shards, const ordered_json& job,
                        const fs::path& first) {
    AtlasHeader header = shards[0].header();
    header.shard = 0;
    header.shards = 0;
    header.counts = {};
    header.layout.texelsHigh = 0;
    const int tileHeight = shards[0].order().tileHeight();
    for (const AtlasTiles& shard : shards) {
        if (header.layout.texelsHigh % tileHeight != 0) {
            throw std::runtime_error(fmt::format(
                "{}: part {} begins within a tile of the whole, and convert --shard cuts between "
                "them; make the parts again",
                first.string(), shard.header().shard));
        }
        header.layout.texelsHigh += shard.header().layout.texelsHigh;
        header.counts += shard.header().counts;
    }
    header.layout.kind = atlasKindFromName(job["layout"].get<std::string>());
    const auto texels = fmt::format("{}x{}", header.layout.texelsWide, header.layout.texelsHigh);
    if (job["texels"] != texels) {
        throw std::runtime_error(fmt::format("{}: its job has {} texels, its parts together {}",
                                             first.string(), job["texels"].get<std::string>(),
                                             texels));
    }
    return header;
}

/// Those of all texels, row by row; none where the shards have none.
std::vector<float> estimatesOf(const std::vector<AtlasTiles>& shards) {
    std::vector<float> rows;
    for (const AtlasTiles& shard : shards) {
        const std::vector<float> more = shard.estimates();
        rows.insert(rows.end(), more.begin(), more.end());
    }
    return rows;
}

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
    const std::vector<AtlasTiles> shards = openShards(options.shards);
    const ordered_json job = jobOf(shards[0], options.shards[0]);
    const AtlasHeader header = wholeHeader(shards, job, options.shards[0]);
    const std::vector<float> estimates = estimatesOf(shards);
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
