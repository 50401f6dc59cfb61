// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/atlas_writer.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/packed_lines.h"
#include "stages/write/exr_chunk.h"
#include "stages/write/exr_head.h"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

namespace abrdf {

namespace {

/// Where the tiles of an unfinished file begin.
std::vector<std::uint64_t> offsetsIn(const std::filesystem::path& partial, std::uint64_t begin,
                                     const WrittenTiles& written, bool hasParts) {
    std::vector<std::uint64_t> offsets;
    std::ifstream stream(partial, std::ios::binary);
    std::vector<char> head(chunkHeadBytes(hasParts));
    std::uint64_t place = begin;
    for (std::size_t i = 0; i < written.tiles; ++i) {
        stream.seekg(static_cast<std::streamoff>(place));
        if (!stream.read(head.data(), static_cast<std::streamsize>(head.size()))) break;
        offsets.push_back(place);
        place += head.size() + chunkDataBytes(head);
    }
    if (offsets.size() != written.tiles || (written.tiles > 0 && place != written.end)) {
        throw std::runtime_error(partial.string() +
                                 ": is not what its journal says; remove both and begin anew");
    }
    return offsets;
}

/// The number of a part, where the file has more than one.
std::optional<int> partOf(int part, bool hasParts) {
    return hasParts ? std::optional(part) : std::nullopt;
}

int cellWidthOf(const AtlasLayout& layout) {
    return layout.kind == AtlasKind::kAngular ? layout.views : layout.texelsWide;
}

int cellHeightOf(const AtlasLayout& layout) {
    return layout.kind == AtlasKind::kAngular ? layout.lights : layout.texelsHigh;
}

}  // namespace

bool fitsHalf(std::span<const Rgb> values) {
    return std::ranges::all_of(values, [](const Rgb& c) {
        return std::max({c.r, c.g, c.b}) <= kLargestHalf;
    });
}

struct AtlasWriter::File {
    ExrHead head;
    std::uint64_t begin;  ///< Of the first chunk; the tables of offsets stand before it.
    std::vector<std::uint64_t> offsets;
    std::uint64_t end;
    std::unique_ptr<OutputFile> output;

    File(const std::filesystem::path& path, const AtlasHeader& header, const TileOrder& order,
         const AtlasWriterOptions& options, int tileWidth, int tileHeight)
        : head(header, options.type, options.compression, tileWidth, tileHeight,
               options.hasEstimate),
          begin(head.bytes().size() +
                (order.tiles() + (options.hasEstimate ? 1 : 0)) * sizeof(std::uint64_t)),
          offsets(offsetsIn(partialBeside(path), begin, options.written, options.hasEstimate)),
          end(std::max(begin, options.written.end)),
          output(options.resumable
                     ? std::make_unique<OutputFile>(path, OutputFile::Partial{options.written.end})
                     : std::make_unique<OutputFile>(path)) {
        output->write(head.bytes());
        if (offsets.empty()) {
            output->write(std::vector<char>(begin - head.bytes().size()));
        } else {
            output->seek(end);
        }
    }
};

AtlasWriter::AtlasWriter(const std::filesystem::path& path, const AtlasHeader& header,
                         const AtlasWriterOptions& options)
    : order_(tileOrderOf(header.layout)),
      texelOrder_(texelOrderOf(header.layout)),
      cellWidth_(cellWidthOf(header.layout)),
      cellHeight_(cellHeightOf(header.layout)),
      type_(options.type),
      hasEstimate_(options.hasEstimate),
      estimates_(hasEstimate_ ? header.layout.texelCount() : 0,
                 std::numeric_limits<float>::quiet_NaN()),
      encoder_(header.layout.width(), header.layout.height(), order_.tileWidth() * cellWidth_,
               order_.tileHeight() * cellHeight_, options.type, options.compression,
               partOf(0, hasEstimate_)),
      file_(std::make_unique<File>(path, header, order_, options, order_.tileWidth() * cellWidth_,
                                   order_.tileHeight() * cellHeight_)) {}

AtlasWriter::~AtlasWriter() = default;

void AtlasWriter::encode(std::size_t index, std::span<const char> packed,
                         std::vector<char>& chunks) const {
    const auto wide = static_cast<std::size_t>(order_.tilesWide());
    encoder_.encode(static_cast<int>(index % wide), static_cast<int>(index / wide), packed, chunks);
}

void AtlasWriter::append(std::size_t count, std::span<const char> chunks) {
    const std::size_t head = chunkHeadBytes(hasEstimate_);
    std::size_t place = 0;
    for (std::size_t i = 0; i < count; ++i) {
        file_->offsets.push_back(file_->end + place);
        place += head + chunkDataBytes(chunks.subspan(place, head));
    }
    assert(place == chunks.size());
    file_->output->write(chunks);
    file_->output->flush();
    file_->end += place;
}

void AtlasWriter::appendData(std::span<const char> data) {
    const auto wide = static_cast<std::size_t>(order_.tilesWide());
    const std::size_t index = file_->offsets.size();
    std::vector<char> chunk;
    appendChunk({partOf(0, hasEstimate_), static_cast<int>(index % wide),
                 static_cast<int>(index / wide), data},
                chunk);
    append(1, chunk);
}

WrittenTiles AtlasWriter::written() const {
    return {file_->offsets.size(), file_->end};
}

std::uint64_t AtlasWriter::writeRows(int firstRow, int rows, std::span<const Rgb> pixels) {
    const auto wide = static_cast<std::size_t>(order_.tilesWide());
    const std::size_t first = file_->offsets.size();
    const std::size_t tileRows =
        (static_cast<std::size_t>(rows) + static_cast<std::size_t>(tileHeight(0)) - 1) /
        static_cast<std::size_t>(tileHeight(0));
    const std::size_t count = tileRows * wide;
    const auto width =
        static_cast<std::size_t>(order_.width()) * static_cast<std::size_t>(cellWidth_);
    std::vector<std::vector<char>> chunks(count);
    std::vector<std::uint64_t> cut(count);
    forEachTexelBlock(count, 1, [&](std::size_t i, std::size_t) {
        const TileOrder::Tile tile = order_.tile(first + i);
        const auto w = static_cast<std::size_t>(tileWidth(first + i));
        const auto h = static_cast<std::size_t>(tileHeight(first + i));
        const std::size_t bytes = bytesOf(type_);
        std::vector<char> packed(3 * bytes * w * h);
        const auto y = static_cast<std::size_t>(tile.y * cellHeight_ - firstRow);
        for (std::size_t line = 0; line < h; ++line) {
            const Rgb* row =
                pixels.data() + (y + line) * width + static_cast<std::size_t>(tile.x * cellWidth_);
            cut[i] +=
                packLines(row, 1, w, type_, {packed.data() + line * 3 * bytes * w, bytes * w, 0});
        }
        encode(first + i, packed, chunks[i]);
    });
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        append(1, chunks[i]);
        total += cut[i];
    }
    return total;
}

void AtlasWriter::keepEstimates(std::size_t first, std::span<const float> deltaE) {
    assert(first + deltaE.size() <= estimates_.size());
    if (deltaE.empty()) return;  // There are none: no piece begins at `first`.
    std::ranges::copy(deltaE, std::span(estimates_).subspan(first).begin());
}

std::vector<float> AtlasWriter::estimates() const {
    std::vector<float> rows(estimates_.size());
    if (hasEstimate_) texelOrder_.restore<float>(estimates_, rows);
    return rows;
}

void AtlasWriter::appendEstimates() {
    const std::vector<float> rows = estimates();
    std::vector<char> chunk;
    appendChunk(
        {1, 0, 0, {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(float)}},
        chunk);
    append(1, chunk);
}

std::uint64_t AtlasWriter::finish(const ValueCounts& counts) {
    if (file_->offsets.size() != order_.tiles()) {
        throw std::logic_error("an atlas was finished before all its tiles were written");
    }
    if (hasEstimate_) appendEstimates();
    OutputFile& output = *file_->output;
    output.seek(0);
    output.write(file_->head.withCounts(counts));
    output.write({reinterpret_cast<const char*>(file_->offsets.data()),
                  file_->offsets.size() * sizeof(std::uint64_t)});
    output.commit();
    return file_->end;
}

}  // namespace abrdf
