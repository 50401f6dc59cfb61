// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/atlas_reader.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfTestFile.h>
#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

namespace {

template <typename Read>
auto readExr(const std::filesystem::path& path, Read read) {
    try {
        Imf::InputFile file(path.c_str(), 0);
        return read(file);
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be read as OpenEXR: {}", path.string(), error.what()));
    }
}

}  // namespace

bool isAtlas(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path) || !Imf::isOpenExrFile(path.c_str())) return false;
    return readExr(path, [](const Imf::InputFile& file) {
        return file.header().find("abrdf:version") != file.header().end();
    });
}

AtlasHeader readAtlasHeader(const std::filesystem::path& path) {
    return readExr(path, [&](const Imf::InputFile& file) {
        return atlasHeaderFrom(file.header(), path.string());
    });
}

Atlas readAtlas(const std::filesystem::path& path) {
    return readExr(path, [&](Imf::InputFile& file) {
        AtlasHeader header = atlasHeaderFrom(file.header(), path.string());
        const auto width = static_cast<std::size_t>(header.layout.width());
        const auto height = static_cast<std::size_t>(header.layout.height());
        // Deflate makes at most 1032 bytes of one: a header that declares more lies.
        constexpr std::uintmax_t kMaxPixelsOfByte = 512;
        if (width * height > kMaxPixelsOfByte * std::filesystem::file_size(path)) {
            throw std::runtime_error(
                fmt::format("{}: is damaged: it declares {} x {} pixels in {} bytes", path.string(),
                            width, height, std::filesystem::file_size(path)));
        }
        std::vector<Rgb> pixels(width * height);
        Imf::FrameBuffer buffer;
        std::size_t offset = 0;
        for (const char* channel : {"R", "G", "B"}) {
            if (file.header().channels().findChannel(channel) == nullptr) {
                throw std::runtime_error(
                    fmt::format("{}: is damaged: it has no channel {}", path.string(), channel));
            }
            buffer.insert(channel,
                          Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(pixels.data()) + offset,
                                     sizeof(Rgb), width * sizeof(Rgb)));
            offset += sizeof(float);
        }
        file.setFrameBuffer(buffer);
        file.readPixels(0, header.layout.height() - 1);
        return Atlas(std::move(header), std::move(pixels));
    });
}

}  // namespace abrdf
