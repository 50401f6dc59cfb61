// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// The chunk of a tile as OpenEXR's files hold it ("File Layout"): the number of its part, where
/// the file has several; its column and row; level 0, 0; the size of its data; the data.
struct ExrChunk {
    std::optional<int> part;  ///< Nothing in a file of one part.
    int tileX = 0;
    int tileY = 0;
    std::span<const char> data;
};

/// Appends its bytes to `chunks`. Throws std::invalid_argument for data of 2 GB or more.
void appendChunk(const ExrChunk& chunk, std::vector<char>& chunks);

/// Bytes before the data.
std::size_t chunkHeadBytes(bool hasParts);

/// Bytes of the data of a chunk that begins with `head`, which has chunkHeadBytes().
std::uint64_t chunkDataBytes(std::span<const char> head);

}  // namespace abrdf
