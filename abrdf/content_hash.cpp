// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/content_hash.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace abrdf {

namespace {

// Odd constants with well mixed bits (of splitmix64).
constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15;
constexpr std::uint64_t kFinal = 0xbf58476d1ce4e5b9;

std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
    const std::uint64_t product = (state ^ word) * kFactor;
    return product ^ (product >> 29);
}

}  // namespace

std::uint64_t contentHash(std::span<const char> bytes, std::uint64_t seed) {
    // Four lanes, so that a multiplication need not wait for the one before.
    std::array<std::uint64_t, 4> lanes = {seed, seed ^ kFactor, seed ^ kFinal, ~seed};
    constexpr std::size_t kWord = sizeof(std::uint64_t);
    constexpr std::size_t kStride = lanes.size() * kWord;
    std::size_t place = 0;
    const auto wordAt = [&](std::size_t at, std::size_t count) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes.data() + at, count);
        return word;
    };
    for (; place + kStride <= bytes.size(); place += kStride) {
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
            lanes[lane] = mixed(lanes[lane], wordAt(place + lane * kWord, kWord));
        }
    }
    std::uint64_t hash = bytes.size();
    for (; place < bytes.size(); place += kWord) {
        hash = mixed(hash, wordAt(place, std::min(kWord, bytes.size() - place)));
    }
    for (const std::uint64_t lane : lanes) hash = mixed(hash, lane);
    hash = (hash ^ (hash >> 32)) * kFinal;
    return hash ^ (hash >> 29);
}

}  // namespace abrdf
