// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/atlas_writer.h"

#include "abrdf/for_each_texel.h"
#include "stages/write/exr_stream.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfTiledOutputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace {

constexpr float kLargestHalf = 65504;

Imf::Compression exrCompression(Compression compression) {
    switch (compression) {
        case Compression::kNone:
            return Imf::NO_COMPRESSION;
        case Compression::kZips:
            return Imf::ZIPS_COMPRESSION;
        case Compression::kZip:
            return Imf::ZIP_COMPRESSION;
        case Compression::kPiz:
            return Imf::PIZ_COMPRESSION;
    }
    return Imf::ZIP_COMPRESSION;
}

/// The smallest multiple of `size` that is at least 64, so that tiny tiles are bundled.
int bundled(int size) {
    return size * ((63 + size) / size);
}

Imf::TileDescription tilesOf(const AtlasLayout& layout) {
    const bool angular = layout.kind == AtlasKind::kAngular;
    const int width = bundled(angular ? layout.views : layout.texelsWide);
    const int height = bundled(angular ? layout.lights : layout.texelsHigh);
    return {static_cast<unsigned>(width), static_cast<unsigned>(height), Imf::ONE_LEVEL};
}

Imf::Header exrHeader(const AtlasHeader& atlas, PixelType type, Compression compression) {
    Imf::Header header(atlas.layout.width(), atlas.layout.height());
    header.compression() = exrCompression(compression);
    header.setTileDescription(tilesOf(atlas.layout));
    for (const char* channel : {"R", "G", "B"}) {
        header.channels().insert(channel,
                                 Imf::Channel(type == PixelType::kHalf ? Imf::HALF : Imf::FLOAT));
    }
    storeAtlasHeader(atlas, header);
    return header;
}

/// `pixels` as packed halfs; values past the range are cut to it and counted.
std::vector<half> halfPixels(std::span<const Rgb> pixels, std::uint64_t& cut) {
    std::vector<half> halfs(3 * pixels.size());
    const auto halfOf = [](float value) { return half(std::min(value, kLargestHalf)); };
    forEachTexel(pixels.size(), [&](std::size_t i) {
        halfs[3 * i] = halfOf(pixels[i].r);
        halfs[3 * i + 1] = halfOf(pixels[i].g);
        halfs[3 * i + 2] = halfOf(pixels[i].b);
    });
    cut += static_cast<std::uint64_t>(std::ranges::count_if(pixels, [](const Rgb& c) {
        return std::max({c.r, c.g, c.b}) > kLargestHalf;
    }));
    return halfs;
}

}  // namespace

std::string nameOf(PixelType type) {
    return type == PixelType::kHalf ? "half" : "float";
}

Compression compressionFromName(const std::string& name) {
    if (name == "none") return Compression::kNone;
    if (name == "zips") return Compression::kZips;
    if (name == "zip") return Compression::kZip;
    if (name == "piz") return Compression::kPiz;
    throw std::invalid_argument(
        fmt::format("there is no compression '{}': use none, zips, zip or piz", name));
}

bool fitsHalf(std::span<const Rgb> values) {
    return std::ranges::all_of(values, [](const Rgb& c) {
        return std::max({c.r, c.g, c.b}) <= kLargestHalf;
    });
}

struct AtlasWriter::File {
    ExrStream stream;
    PixelType type;
    Imf::Header header;
    std::unique_ptr<Imf::TiledOutputFile> output;

    File(const std::filesystem::path& path, const AtlasHeader& atlas, PixelType pixelType,
         Compression compression)
        : stream(path),
          type(pixelType),
          header(exrHeader(atlas, pixelType, compression)),
          output(std::make_unique<Imf::TiledOutputFile>(stream, header, 0)) {}

    void writeTiles(int firstRow, int rows, const char* base, std::size_t channelSize) {
        const auto width = static_cast<std::size_t>(header.dataWindow().max.x + 1);
        const std::size_t pixelSize = 3 * channelSize;
        // OpenEXR addresses a pixel (x, y) of the whole image; ours begin at firstRow.
        const auto origin = reinterpret_cast<std::uintptr_t>(base) -
                            static_cast<std::uintptr_t>(firstRow) * width * pixelSize;
        Imf::FrameBuffer buffer;
        std::size_t channel = 0;
        for (const char* name : {"R", "G", "B"}) {
            buffer.insert(name, Imf::Slice(type == PixelType::kHalf ? Imf::HALF : Imf::FLOAT,
                                           reinterpret_cast<char*>(origin + channel * channelSize),
                                           pixelSize, width * pixelSize));
            ++channel;
        }
        output->setFrameBuffer(buffer);
        const int height = static_cast<int>(output->tileYSize());
        output->writeTiles(0, output->numXTiles(0) - 1, firstRow / height,
                           (firstRow + rows - 1) / height);
    }
};

AtlasWriter::AtlasWriter(const std::filesystem::path& path, const AtlasHeader& header,
                         PixelType type, Compression compression)
    : file_(std::make_unique<File>(path, header, type, compression)) {}

AtlasWriter::~AtlasWriter() = default;

int AtlasWriter::tileHeight() const {
    return static_cast<int>(file_->output->tileYSize());
}

std::uint64_t AtlasWriter::writeRows(int firstRow, int rows, std::span<const Rgb> pixels) {
    std::uint64_t cut = 0;
    if (file_->type == PixelType::kHalf) {
        const std::vector<half> halfs = halfPixels(pixels, cut);
        file_->writeTiles(firstRow, rows, reinterpret_cast<const char*>(halfs.data()),
                          sizeof(half));
    } else {
        file_->writeTiles(firstRow, rows, reinterpret_cast<const char*>(pixels.data()),
                          sizeof(float));
    }
    return cut;
}

std::uint64_t AtlasWriter::finish(const ValueCounts& counts) {
    // Destroyed, OpenEXR's file writes its table of tiles; the stream remembers a failure there.
    file_->output.reset();
    file_->stream.patchInt("abrdf:clamped", headerCount(counts.clamped));
    file_->stream.patchInt("abrdf:extrapolated", headerCount(counts.extrapolated));
    file_->stream.patchInt("abrdf:nonfinite", headerCount(counts.nonfinite));
    return file_->stream.commit();
}

}  // namespace abrdf
