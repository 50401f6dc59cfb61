// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/exr_chunk.h"

#include <array>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace abrdf {

namespace {

using Number = std::int32_t;

void append(std::span<const Number> numbers, std::vector<char>& bytes) {
    const auto* begin = reinterpret_cast<const char*>(numbers.data());
    bytes.insert(bytes.end(), begin, begin + numbers.size_bytes());
}

}  // namespace

void appendChunk(const ExrChunk& chunk, std::vector<char>& chunks) {
    if (chunk.data.size() > static_cast<std::size_t>(std::numeric_limits<Number>::max())) {
        throw std::invalid_argument("a tile of an atlas is too large for OpenEXR: 2 GB or more");
    }
    if (chunk.part) append(std::array<Number, 1>{*chunk.part}, chunks);
    append(std::array<Number, 5>{chunk.tileX, chunk.tileY, 0, 0,
                                 static_cast<Number>(chunk.data.size())},
           chunks);
    chunks.insert(chunks.end(), chunk.data.begin(), chunk.data.end());
}

std::size_t chunkHeadBytes(bool hasParts) {
    return (hasParts ? 6 : 5) * sizeof(Number);
}

std::uint64_t chunkDataBytes(std::span<const char> head) {
    Number size = 0;
    std::memcpy(&size, head.last(sizeof size).data(), sizeof size);
    return static_cast<std::uint64_t>(size);
}

}  // namespace abrdf
