// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/btf_table.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace abrdf {

namespace {

constexpr std::uint8_t kFull = 0;
constexpr std::uint8_t kSparse = 2;

}  // namespace

BtfTable::BtfTable(ByteCursor& file, BtfExtent& extent) {
    extent.width = file.u32("width");
    extent.height = file.u32("height");
    const std::uint32_t linesOfChunk = file.u32("chunk size");
    const auto compression = file.number<std::uint8_t>("compression");
    if (compression != kFull && compression != kSparse) {
        file.fail(
            fmt::format("its chunks are compressed in way {}, read are 0 and 2", compression));
    }
    if (extent.width == 0 || extent.height == 0 || linesOfChunk == 0) {
        file.fail(fmt::format("it declares {} x {} texels in chunks of {} lines", extent.width,
                              extent.height, linesOfChunk));
    }
    const auto mask = file.take(std::uint64_t{extent.width} * extent.height, "mask");
    skipBtfRotations(file);
    extent_ = extent;
    const std::uint64_t texelBytes =
        sizeof(Imath::half) * extent.channels * static_cast<std::uint64_t>(extent.pairs());
    const std::uint64_t texelsOfChunk = std::uint64_t{extent.width} * linesOfChunk;
    std::span<const char> chunk;
    std::uint64_t stored = 0;
    for (const char isStored : mask) {
        if (isStored == 0 && compression == kSparse) {
            texels_.emplace_back();
            continue;
        }
        if (stored++ % texelsOfChunk == 0) {
            chunk = file.take(file.u32("chunk"), "chunk");
        }
        if (chunk.size() < texelBytes) {
            file.fail(fmt::format("a chunk ends before texel {}", texels_.size()));
        }
        texels_.push_back(isStored == 0 ? std::span<const char>() : chunk.first(texelBytes));
        chunk = chunk.subspan(texelBytes);
    }
}

void BtfTable::decode(std::size_t a, std::span<float> out) const {
    const std::size_t channels = extent_.channels;
    for (std::size_t t = 0; t < texels_.size(); ++t) {
        for (std::size_t c = 0; c < channels; ++c) {
            float& value = out[c + channels * t];
            value = std::numeric_limits<float>::quiet_NaN();
            if (texels_[t].empty()) continue;
            Imath::half number;
            std::memcpy(&number, texels_[t].data() + sizeof number * (c + channels * a),
                        sizeof number);
            value = number;
        }
    }
}

}  // namespace abrdf
