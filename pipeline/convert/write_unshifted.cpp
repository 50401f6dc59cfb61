// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/write_unshifted.h"

#include "abrdf/for_each_texel.h"
#include "pipeline/convert/unshifted_texels.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <stdexcept>

namespace abrdf {

namespace {

/// Rows of aligned texels, made but not finished.
ReconstructedTexels alignedRows(const ImageStack& stack, const TexelMaker& maker, int first,
                                int count) {
    const auto width = static_cast<std::size_t>(stack.width());
    const std::size_t texels = width * static_cast<std::size_t>(count);
    ReconstructedTexels result{AbrdfTile(texels, maker.pairs), {}};
    std::atomic<std::uint64_t> clamped = 0;
    std::atomic<std::uint64_t> nonfinite = 0;
    std::atomic<std::uint64_t> dimmed = 0;
    forEachTexelBlock(
        texels, maker.reconstructor.texelsAtOnce(), [&](std::size_t begin, std::size_t end) {
            TexelMaker::Buffers buffers;
            maker.makeUnfinished(stack.values(), static_cast<std::size_t>(first) * width + begin,
                                 end - begin, buffers);
            std::ranges::copy(buffers.abrdfs,
                              result.abrdfs.values().subspan(begin * maker.pairs).begin());
            clamped += buffers.unreal.clamped;
            nonfinite += buffers.unreal.nonfinite;
            dimmed += buffers.unreal.dimmed;
        });
    result.unreal = {clamped, nonfinite, dimmed};
    return result;
}

/// Pixels of the rows of texels from `first` on, row by row over the atlas's width.
std::vector<Rgb> pixelsOf(const AbrdfTile& texels, const AtlasLayout& layout, int first) {
    const auto wide = static_cast<std::size_t>(layout.texelsWide);
    const auto pixelsWide = static_cast<std::size_t>(layout.width());
    std::vector<Rgb> pixels(texels.values().size());
    const int firstPixel = layout.pixelFromSample({0, first, 0, 0}).y;
    forEachTexelBlock(texels.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        for (std::size_t pair = 0; pair < texels.valuesPerTexel(); ++pair) {
            const auto views = static_cast<std::size_t>(layout.views);
            const AtlasPixel p = layout.pixelFromSample(
                {static_cast<int>(texel % wide), first + static_cast<int>(texel / wide),
                 static_cast<int>(pair / views), static_cast<int>(pair % views)});
            pixels[static_cast<std::size_t>(p.y - firstPixel) * pixelsWide +
                   static_cast<std::size_t>(p.x)] = texels[texel][pair];
        }
    });
    return pixels;
}

/// Rows of texels at once: whole tiles, about 16 MB of values; all where a tile holds all texels.
int rowsAtOnce(const AtlasLayout& layout, const AtlasWriter& writer, std::size_t pairs) {
    if (layout.kind == AtlasKind::kSpatial) return layout.texelsHigh;
    const int rowsOfTile = writer.order().tileHeight();
    const std::uint64_t bytes = sizeof(Rgb) * pairs *
                                static_cast<std::uint64_t>(layout.texelsWide) *
                                static_cast<std::uint64_t>(rowsOfTile);
    const auto tiles = static_cast<int>((std::uint64_t{16} << 20) / bytes);
    return std::min(layout.texelsHigh, rowsOfTile * std::max(1, tiles));
}

/// Returns false where a half cannot hold a value and the atlas should become one of floats.
bool writeAs(PixelType type, const ConvertJob& job, const ConvertOptions& options,
             const ImageStack& aligned, const TexelMaker& maker, WrittenAtlas& written,
             const ProgressSink& progress) {
    const AtlasLayout& layout = job.layout();
    AtlasWriter writer(options.output, job.header, {type, options.compression, false, {}});
    written.type = type;
    written.counts = job.header.counts;
    written.dimmed = 0;
    UnshiftedTexels unshifted(
        job.found.plane, job.input.description(), job.texels, job.grid,
        [&](int first, int count) { return alignedRows(aligned, maker, first, count); });
    const int rows = rowsAtOnce(layout, writer, maker.pairs);
    for (int row = 0; row < layout.texelsHigh; row += rows) {
        const int count = std::min(rows, layout.texelsHigh - row);
        ReconstructedTexels texels = unshifted.rows(row, count);
        forEachTexelBlock(texels.abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
            maker.finisher.finish(texels.abrdfs[texel]);
        });
        written.counts.clamped += texels.unreal.clamped;
        written.counts.nonfinite += texels.unreal.nonfinite;
        written.dimmed += texels.unreal.dimmed;
        if (options.pixel == PixelChoice::kAuto && type == PixelType::kHalf &&
            !fitsHalf(texels.abrdfs.values())) {
            return false;
        }
        const std::vector<Rgb> pixels = pixelsOf(texels.abrdfs, layout, row);
        written.counts.clamped += writer.writeRows(
            layout.pixelFromSample({0, row, 0, 0}).y,
            static_cast<int>(pixels.size() / static_cast<std::size_t>(layout.width())), pixels);
        if (progress) {
            progress({"reconstruct", "texels",
                      static_cast<std::size_t>(row + count) *
                          static_cast<std::size_t>(layout.texelsWide),
                      layout.texelCount()});
        }
    }
    written.bytes = writer.finish(written.counts);
    return true;
}

}  // namespace

void checkUnshiftedMemory(const ConvertJob& job, const ConvertOptions& options) {
    const std::uint64_t samples =
        sizeof(Rgb) * job.samples().pairs.size() * job.texels.count() + job.memory.fixedBytes;
    const std::uint64_t rows = job.layout().kind == AtlasKind::kSpatial
                                   ? 3 * sizeof(Rgb) * job.grid.pairCount() * job.texels.count()
                                   : std::uint64_t{128} << 20;
    if (samples + rows <= options.memory) return;
    throw std::invalid_argument(
        fmt::format("--unshift holds all samples in memory, which is bounded to {} MB; give it "
                    "--memory {}M or more, or leave it out",
                    options.memory >> 20, ((samples + rows) >> 20) + 1));
}

WrittenAtlas writeUnshifted(const ConvertJob& job, const ConvertOptions& options,
                            const ImageStack& aligned, const TexelMaker& maker,
                            const ProgressSink& progress) {
    WrittenAtlas written;
    if (!writeAs(firstType(options.pixel), job, options, aligned, maker, written, progress)) {
        writeAs(PixelType::kFloat, job, options, aligned, maker, written, progress);
    }
    return written;
}

}  // namespace abrdf
