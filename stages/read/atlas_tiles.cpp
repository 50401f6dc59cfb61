// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/atlas_tiles.h"

#include "stages/read/atlas_reader.h"
#include "stages/read/exr_header_check.h"
#include "stages/read/mapped_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfTiledInputFile.h>
#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

namespace {

template <typename Read>
auto guarded(const std::filesystem::path& path, Read read) {
    try {
        return read();
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be read as tiled OpenEXR: {}", path.string(), error.what()));
    }
}

}  // namespace

struct AtlasTiles::File {
    std::filesystem::path path;
    Imf::TiledInputFile exr;
    AtlasHeader header;
    TileOrder order;
    PixelType type;

    explicit File(const std::filesystem::path& name)
        : path(name),
          exr(name.c_str(), 0),
          header(atlasHeaderFrom(exr.header(), name.string())),
          order(tileOrderOf(header.layout)),
          type(PixelType::kHalf) {
        for (const char* channel : {"R", "G", "B"}) {
            const Imf::Channel* found = exr.header().channels().findChannel(channel);
            if (found == nullptr) {
                throw std::runtime_error(
                    fmt::format("{}: is damaged: it has no channel {}", path.string(), channel));
            }
            if (found->type != Imf::HALF) type = PixelType::kFloat;
        }
        if (exr.numXTiles() != order.tilesWide() || exr.numYTiles() != order.tilesHigh()) {
            throw std::runtime_error(fmt::format(
                "{}: has other tiles than this program writes; convert it anew", path.string()));
        }
    }

    int column(std::size_t index) const {
        return static_cast<int>(index % static_cast<std::size_t>(order.tilesWide()));
    }
    int row(std::size_t index) const {
        return static_cast<int>(index / static_cast<std::size_t>(order.tilesWide()));
    }
};

AtlasTiles::AtlasTiles(const std::filesystem::path& path) {
    checkExrHeader(MappedFile(path).bytes(), path.string());
    file_ = guarded(path, [&] { return std::make_unique<File>(path); });
}
AtlasTiles::~AtlasTiles() = default;
AtlasTiles::AtlasTiles(AtlasTiles&&) noexcept = default;

const AtlasHeader& AtlasTiles::header() const {
    return file_->header;
}
PixelType AtlasTiles::type() const {
    return file_->type;
}
const TileOrder& AtlasTiles::order() const {
    return file_->order;
}

std::vector<char> AtlasTiles::raw(std::size_t index) const {
    return guarded(file_->path, [&] {
        int x = file_->column(index);
        int y = file_->row(index);
        const int wantedX = x;
        const int wantedY = y;
        int levelX = 0;
        int levelY = 0;
        const char* data = nullptr;
        int size = 0;
        file_->exr.rawTileData(x, y, levelX, levelY, data, size);
        if (x != wantedX || y != wantedY || levelX != 0 || levelY != 0 || size < 0) {
            throw std::runtime_error(
                fmt::format("{}: is damaged: tile ({}, {}) is not where its table says",
                            file_->path.string(), wantedX, wantedY));
        }
        return std::vector<char>(data, data + size);
    });
}

std::vector<Rgb> AtlasTiles::pixels(std::size_t index) const {
    return guarded(file_->path, [&] {
        const Imath::Box2i box =
            file_->exr.dataWindowForTile(file_->column(index), file_->row(index));
        const auto width = static_cast<std::size_t>(box.max.x - box.min.x + 1);
        const auto height = static_cast<std::size_t>(box.max.y - box.min.y + 1);
        std::vector<Rgb> values(width * height);
        Imf::FrameBuffer buffer;
        std::size_t offset = 0;
        for (const char* channel : {"R", "G", "B"}) {
            buffer.insert(channel, Imf::Slice::Make(Imf::FLOAT,
                                                    reinterpret_cast<char*>(values.data()) + offset,
                                                    box, sizeof(Rgb), width * sizeof(Rgb)));
            offset += sizeof(float);
        }
        file_->exr.setFrameBuffer(buffer);
        file_->exr.readTile(file_->column(index), file_->row(index));
        return values;
    });
}

std::vector<float> AtlasTiles::estimates() const {
    return readEstimates(file_->path);
}

}  // namespace abrdf
