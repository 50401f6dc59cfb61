// SPDX-License-Identifier: BSD-3-Clause
//
// OpenEXR, "File Layout": magic, version, then for each part its attributes: name \0 type \0
// int32 size, value; a part ends with an empty name, the parts of a multi-part file with another.
#include "stages/read/exr_header_check.h"

#include "stages/read/byte_cursor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace abrdf {

namespace {

constexpr std::string_view kMagic = "\x76\x2f\x31\x01";
constexpr std::uint32_t kMultiPart = 0x1000;

// Deflate makes at most 1032 bytes of one; a megabyte for headers and small images.
constexpr std::uint64_t kMaxExpansion = 4096;
constexpr std::uint64_t kSmall = std::uint64_t{1} << 20;

/// The numbers of a part that OpenEXR takes memory by.
struct Part {
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::uint64_t channels = 1;
    std::uint64_t linesOfChunk = 1;
    bool isTiled = false;  ///< By its tiles; in a file of several parts its type decides.
    std::uint64_t tileWidth = 1;
    std::uint64_t tileHeight = 1;
    std::string type;             ///< "tiledimage", ...; must be there in a file of several parts.
    std::int64_t chunkCount = 0;  ///< As the part says.
};

/// Text up to a zero byte.
std::string readName(ByteCursor& file) {
    std::string name;
    for (char c = file.number<char>("name"); c != '\0'; c = file.number<char>("name")) {
        name += c;
        if (name.size() > 255) file.fail("an attribute's name is longer than 255 characters");
    }
    return name;
}

std::uint64_t linesOfCompression(std::uint8_t compression) {
    // none rle zips zip piz pxr24 b44 b44a dwaa dwab
    constexpr std::array<std::uint64_t, 10> kLines = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    return compression < kLines.size() ? kLines[compression] : 256;
}

struct SizedType {
    std::string_view name;
    std::int32_t bytes;
};
/// OpenEXR reads these by their type, whatever size the file says: they must agree.
constexpr std::array kSizedTypes{
    SizedType{"box2i", 16},   SizedType{"box2f", 16},      SizedType{"chromaticities", 32},
    SizedType{"double", 8},   SizedType{"compression", 1}, SizedType{"deepImageState", 1},
    SizedType{"envmap", 1},   SizedType{"float", 4},       SizedType{"int", 4},
    SizedType{"keycode", 28}, SizedType{"lineOrder", 1},   SizedType{"m33f", 36},
    SizedType{"m33d", 72},    SizedType{"m44f", 64},       SizedType{"m44d", 128},
    SizedType{"rational", 8}, SizedType{"tiledesc", 9},    SizedType{"timecode", 8},
    SizedType{"v2i", 8},      SizedType{"v2f", 8},         SizedType{"v2d", 16},
    SizedType{"v3i", 12},     SizedType{"v3f", 12},        SizedType{"v3d", 24},
};

/// The channels of a list, which must end where its attribute does.
std::uint64_t channelsIn(ByteCursor& list) {
    constexpr std::uint64_t kBytesOfChannel = 16;
    std::uint64_t count = 0;
    while (!readName(list).empty()) {
        list.take(kBytesOfChannel, "channel");
        ++count;
    }
    if (list.left() > 0) list.fail("its list of channels ends before its attribute");
    return std::max<std::uint64_t>(1, count);
}

void checkTexts(ByteCursor& texts) {
    while (texts.left() > 0) {
        const auto size = texts.number<std::int32_t>("text");
        if (size < 0) texts.fail(fmt::format("it declares a text of {} characters", size));
        texts.take(static_cast<std::uint64_t>(size), "text");
    }
}

void readAttribute(ByteCursor& file, const std::string& name, Part& part) {
    const std::string type = readName(file);
    const auto size = file.number<std::int32_t>("attribute");
    if (size < 0) file.fail(fmt::format("its attribute {} has a size of {}", name, size));
    for (const SizedType& sized : kSizedTypes) {
        if (type == sized.name && size != sized.bytes) {
            file.fail(fmt::format("its {} attribute {} has {} bytes", type, name, size));
        }
    }
    const auto value = file.take(static_cast<std::uint64_t>(size), name.c_str());
    ByteCursor content(value, file.name());
    if (type == "box2i" && name == "dataWindow") {
        std::array<std::int64_t, 4> box{};
        for (std::int64_t& side : box) side = content.number<std::int32_t>("data window");
        part.width = box[2] - box[0] + 1;
        part.height = box[3] - box[1] + 1;
    } else if (type == "chlist") {
        part.channels = channelsIn(content);
    } else if (type == "stringvector") {
        checkTexts(content);
    } else if (type == "floatvector" && size % 4 != 0) {
        file.fail(fmt::format("its floatvector {} has {} bytes", name, size));
    } else if (type == "idmanifest" && size < 8) {
        file.fail("its manifest of ids has no size");
    } else if (type == "compression") {
        part.linesOfChunk = linesOfCompression(content.number<std::uint8_t>("compression"));
    } else if (type == "tiledesc") {
        part.isTiled = true;
        part.tileWidth = content.u32("tile size");
        part.tileHeight = content.u32("tile size");
    } else if (type == "string" && name == "type") {
        part.type.assign(value.begin(), value.end());
    } else if (type == "int" && name == "chunkCount") {
        part.chunkCount = content.number<std::int32_t>("chunkCount");
    } else if (type == "preview") {
        const std::uint64_t pixels =
            boundedProduct(content.u32("preview"), content.u32("preview"), value.size());
        if (4 * pixels != content.left()) file.fail("its preview is not as large as it says");
    }
}

/// Returns how many chunks the part has.
std::uint64_t checkPart(const ByteCursor& file, const Part& part, std::uint64_t fileSize) {
    const std::uint64_t most = kMaxExpansion * fileSize + kSmall;
    if (part.width < 1 || part.height < 1) {
        file.fail(fmt::format("it declares {} x {} pixels", part.width, part.height));
    }
    const auto width = static_cast<std::uint64_t>(part.width);
    const auto height = static_cast<std::uint64_t>(part.height);
    const std::uint64_t pixels = boundedProduct(width, height, most);
    const std::uint64_t chunk = part.isTiled ? boundedProduct(part.tileWidth, part.tileHeight, most)
                                             : boundedProduct(width, part.linesOfChunk, most);
    const std::uint64_t chunkBytes = boundedProduct(chunk, 4 * part.channels, most);
    if (part.isTiled && (part.tileWidth == 0 || part.tileHeight == 0)) {
        file.fail("it declares tiles without a size");
    }
    // Each chunk has 8 bytes in a table.
    const std::uint64_t chunks =
        part.isTiled ? boundedProduct((width + part.tileWidth - 1) / part.tileWidth,
                                      (height + part.tileHeight - 1) / part.tileHeight, most)
                     : height / part.linesOfChunk;
    if (pixels > most || chunkBytes > most || chunks > fileSize / 8) {
        file.fail(
            fmt::format("it declares {} x {} pixels of {} channels in {} chunks, and has {} "
                        "bytes",
                        width, height, part.channels, chunks, fileSize));
    }
    return chunks;
}

/// The same for one of several parts, which together have `before` chunks before it.
std::uint64_t checkPartOfMany(const ByteCursor& file, Part part, std::uint64_t before,
                              std::uint64_t fileSize) {
    part.isTiled = part.type == "tiledimage" || part.type == "deeptile";
    const std::uint64_t chunks = checkPart(file, part, fileSize);
    if (part.chunkCount < 0) {
        file.fail(fmt::format("one of its parts declares {} chunks", part.chunkCount));
    }
    const std::uint64_t most = std::max(chunks, static_cast<std::uint64_t>(part.chunkCount));
    if (before + most > fileSize / 8) {
        file.fail(fmt::format("its parts declare {} chunks, and it has {} bytes", before + most,
                              fileSize));
    }
    return most;
}

}  // namespace

bool beginsAsExr(std::span<const char> bytes) {
    return std::string_view(bytes.data(), bytes.size()).starts_with(kMagic);
}

void checkExrHeader(std::span<const char> bytes, const std::string& name) {
    ByteCursor file(bytes, name);
    file.take(kMagic.size(), "magic number");
    const std::uint32_t version = file.u32("version");
    const bool isMultiPart = (version & kMultiPart) != 0;
    std::uint64_t chunks = 0;
    std::string attribute = readName(file);
    do {
        Part part;
        while (!attribute.empty()) {
            readAttribute(file, attribute, part);
            attribute = readName(file);
        }
        if (isMultiPart) {
            chunks += checkPartOfMany(file, part, chunks, bytes.size());
            attribute = readName(file);  // Of the next part; an empty header ends them.
        } else {
            checkPart(file, part, bytes.size());
        }
    } while (!attribute.empty());
}

}  // namespace abrdf
