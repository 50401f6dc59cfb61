// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/exr_head.h"

#include "abrdf/tile_order.h"

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace abrdf {

namespace {

/// OpenEXR's output into memory.
class MemoryStream : public Imf::OStream {
  public:
    MemoryStream() : Imf::OStream("an atlas's header") {}

    void write(const char bytes[], int count) override {
        bytes_.resize(std::max(bytes_.size(), place_));
        bytes_.replace(place_, static_cast<std::size_t>(count), bytes,
                       static_cast<std::size_t>(count));
        place_ += static_cast<std::size_t>(count);
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t position) override { place_ = position; }

    std::string& bytes() { return bytes_; }

  private:
    std::string bytes_;
    std::size_t place_ = 0;
};

std::string fourBytes(std::uint32_t value) {
    return {static_cast<char>(value), static_cast<char>(value >> 8U),
            static_cast<char>(value >> 16U), static_cast<char>(value >> 24U)};
}

bool hasLongName(const Imf::Header& header) {
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        if (std::string_view(attribute.name()).size() > 31) return true;
    }
    return false;
}

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

Imf::Header rgbHeader(const AtlasHeader& atlas, PixelType type, Compression compression,
                      int tileWidth, int tileHeight) {
    Imf::Header header(atlas.layout.width(), atlas.layout.height());
    header.compression() = exrCompression(compression);
    header.setTileDescription(
        {static_cast<unsigned>(tileWidth), static_cast<unsigned>(tileHeight), Imf::ONE_LEVEL});
    for (const char* channel : {"R", "G", "B"}) {
        header.channels().insert(channel,
                                 Imf::Channel(type == PixelType::kHalf ? Imf::HALF : Imf::FLOAT));
    }
    storeAtlasHeader(atlas, header);
    return header;
}

/// What a file of several parts says of each.
void setPart(Imf::Header& header, const char* name, std::size_t tiles) {
    header.setName(name);
    header.setType(Imf::TILEDIMAGE);
    header.setChunkCount(static_cast<int>(tiles));
}

/// One pixel a texel. The format wants display window and chromaticities alike in all parts.
Imf::Header estimateHeader(const AtlasLayout& layout, const Imf::Header& rgb) {
    Imf::Header header(rgb.displayWindow(),
                       Imath::Box2i({0, 0}, {layout.texelsWide - 1, layout.texelsHigh - 1}));
    header.compression() = Imf::NO_COMPRESSION;
    header.setTileDescription({static_cast<unsigned>(layout.texelsWide),
                               static_cast<unsigned>(layout.texelsHigh), Imf::ONE_LEVEL});
    header.channels().insert("deltaE", Imf::Channel(Imf::FLOAT));
    header.insert("colorInteropID", Imf::StringAttribute("data"));
    if (Imf::hasChromaticities(rgb)) Imf::addChromaticities(header, Imf::chromaticities(rgb));
    setPart(header, "estimate", 1);
    return header;
}

void patchInt(std::string& bytes, std::string_view attribute, int value) {
    // An attribute is: name \0 type \0 size(4) value.
    const std::string key = std::string(attribute) + '\0' + "int" + '\0' + fourBytes(4);
    const std::size_t found = bytes.find(key);
    if (found == std::string::npos) {
        throw std::logic_error("the EXR header lacks the attribute " + std::string(attribute));
    }
    bytes.replace(found + key.size(), 4, fourBytes(static_cast<std::uint32_t>(value)));
}

}  // namespace

ExrHead::ExrHead(const AtlasHeader& atlas, PixelType type, Compression compression, int tileWidth,
                 int tileHeight, bool hasEstimate) {
    std::vector<Imf::Header> parts = {rgbHeader(atlas, type, compression, tileWidth, tileHeight)};
    if (hasEstimate) {
        setPart(parts[0], "rgb", tileOrderOf(atlas.layout).tiles());
        parts.push_back(estimateHeader(atlas.layout, parts[0]));
    }
    const int form = hasEstimate ? Imf::MULTI_PART_FILE_FLAG : Imf::TILED_FLAG;
    const int names = std::ranges::any_of(parts, hasLongName) ? Imf::LONG_NAMES_FLAG : 0;
    const auto version = static_cast<std::uint32_t>(Imf::EXR_VERSION | form | names);
    MemoryStream stream;
    const std::string begin =
        fourBytes(static_cast<std::uint32_t>(Imf::MAGIC)) + fourBytes(version);
    stream.write(begin.data(), static_cast<int>(begin.size()));
    for (const Imf::Header& part : parts) {
        part.sanityCheck(true, hasEstimate);
        part.writeTo(stream, true);
    }
    if (hasEstimate) stream.write("", 1);  // An empty header ends them.
    bytes_ = std::move(stream.bytes());
}

std::string ExrHead::withCounts(const ValueCounts& counts) const {
    std::string bytes = bytes_;
    patchInt(bytes, "abrdf:clamped", headerCount(counts.clamped));
    patchInt(bytes, "abrdf:extrapolated", headerCount(counts.extrapolated));
    patchInt(bytes, "abrdf:nonfinite", headerCount(counts.nonfinite));
    return bytes;
}

}  // namespace abrdf
