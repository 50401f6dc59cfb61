// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/atlas_reader.h"

#include "stages/read/exr_header_check.h"
#include "stages/read/mapped_file.h"
#include "stages/read/model_reader.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

namespace {

/// File: InputFile, for part 0, or MultiPartInputFile.
template <typename File = Imf::InputFile, typename Read>
auto readExr(const std::filesystem::path& path, Read read) {
    checkExrHeader(MappedFile(path).bytes(), path.string());
    try {
        File file(path.c_str(), 0);
        return read(file);
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error(
            fmt::format("{}: cannot be read as OpenEXR: {}", path.string(), error.what()));
    }
}

std::vector<float> estimatesIn(Imf::MultiPartInputFile& file, int part, const AtlasLayout& layout,
                               const std::string& name) {
    const Imath::Box2i box = file.header(part).dataWindow();
    if (file.header(part).channels().findChannel("deltaE") == nullptr ||
        box.size() + Imath::V2i(1) != Imath::V2i(layout.texelsWide, layout.texelsHigh)) {
        throw std::runtime_error(fmt::format(
            "{}: is damaged: its part estimate has no pixel deltaE for each texel", name));
    }
    std::vector<float> values(layout.texelCount());
    Imf::FrameBuffer buffer;
    const auto wide = static_cast<std::size_t>(layout.texelsWide);
    buffer.insert("deltaE", Imf::Slice::Make(Imf::FLOAT, values.data(), box, sizeof(float),
                                             wide * sizeof(float)));
    Imf::InputPart input(file, part);
    input.setFrameBuffer(buffer);
    input.readPixels(box.min.y, box.max.y);
    return values;
}

/// Measured values pack to a third, black to a hundredth: more than 64 pixels in a byte are a bomb.
void checkPacking(const std::filesystem::path& path, std::size_t pixels) {
    constexpr std::size_t kSmall = std::size_t{1} << 26;
    const std::uintmax_t bytes = std::filesystem::file_size(path);
    if (pixels <= kSmall || pixels / 64 <= bytes) return;
    throw std::runtime_error(
        fmt::format("{}: is no atlas to be believed: it declares {} pixels in {} bytes",
                    path.string(), pixels, bytes));
}

}  // namespace

bool isAtlas(const std::filesystem::path& path) {
    std::error_code error;  // Names that no file can have are no atlas.
    if (!std::filesystem::is_regular_file(path, error) || !beginsAsExr(MappedFile(path).bytes())) {
        return false;
    }
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
    if (readAtlasHeader(path).layout.kind == AtlasKind::kModel) {
        return expanded(readModelAtlas(path));
    }
    return readExr(path, [&](Imf::InputFile& file) {
        AtlasHeader header = atlasHeaderFrom(file.header(), path.string());
        const auto width = static_cast<std::size_t>(header.layout.width());
        const auto height = static_cast<std::size_t>(header.layout.height());
        checkPacking(path, width * height);
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

std::vector<float> readEstimates(const std::filesystem::path& path) {
    return readExr<Imf::MultiPartInputFile>(path, [&](Imf::MultiPartInputFile& file) {
        const AtlasLayout layout = atlasHeaderFrom(file.header(0), path.string()).layout;
        for (int part = 1; part < file.parts(); ++part) {
            if (file.header(part).name() != "estimate") continue;
            return estimatesIn(file, part, layout, path.string());
        }
        return std::vector<float>();
    });
}

}  // namespace abrdf
