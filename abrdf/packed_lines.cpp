// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/packed_lines.h"

#include "abrdf/register_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace abrdf {

namespace {

static_assert(std::endian::native == std::endian::little && sizeof(Rgb) == 3 * sizeof(float));

// Colours at once: their channels stay in the innermost cache.
constexpr std::size_t kPiece = 256;
using Channels = std::array<std::array<float, kPiece>, 3>;
using Halfs = std::array<std::uint16_t, kPiece>;

/// The bits of x as a half. Without a branch, so that compilers make vectors of it.
[[gnu::always_inline]] inline std::uint16_t halfBits(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const float size = std::fabs(x) <= kLargestHalf ? std::fabs(x) : kLargestHalf;
    const auto sizeBits = std::bit_cast<std::uint32_t>(size);
    // Normal: 13 bits of the mantissa are rounded away, the exponent's bias goes from 127 to 15.
    const std::uint32_t normal =
        ((sizeBits + 0xfffU + ((sizeBits >> 13U) & 1U)) >> 13U) - (112U << 10U);
    // Subnormal, below 2^-14: beside 1/2 a float's last bit is 2^-24, so that adding rounds.
    const std::uint32_t subnormal = std::bit_cast<std::uint32_t>(size + 0.5F) - 0x3f000000U;
    const std::uint32_t value = sizeBits < 0x38800000U ? subnormal : normal;
    return static_cast<std::uint16_t>(value | ((bits >> 16U) & 0x8000U));
}

[[gnu::always_inline]] inline void separate(const Rgb* colors, std::size_t count,
                                            Channels& channels) {
    for (std::size_t i = 0; i < count; ++i) {
        channels[0][i] = colors[i].b;
        channels[1][i] = colors[i].g;
        channels[2][i] = colors[i].r;
    }
}

/// How many colours no half can hold; nearly always none.
[[gnu::always_inline]] inline std::uint64_t countPast(const Channels& channels, std::size_t count) {
    std::uint32_t past = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool fits = std::fabs(channels[0][i]) <= kLargestHalf &&
                          std::fabs(channels[1][i]) <= kLargestHalf &&
                          std::fabs(channels[2][i]) <= kLargestHalf;
        past += fits ? 0U : 1U;
    }
    return past;
}

/// One piece of a line as floats, or as halfs.
[[gnu::always_inline]] inline std::uint64_t packPiece(const Rgb* colors, std::size_t count,
                                                      PixelType type, char* out,
                                                      std::size_t channelStride) {
    Channels channels;
    separate(colors, count, channels);
    for (std::size_t c = 0; c < 3; ++c, out += channelStride) {
        if (type == PixelType::kFloat) {
            std::memcpy(out, channels[c].data(), count * sizeof(float));
            continue;
        }
        Halfs halfs;
        for (std::size_t i = 0; i < count; ++i) halfs[i] = halfBits(channels[c][i]);
        std::memcpy(out, halfs.data(), count * sizeof(std::uint16_t));
    }
    return type == PixelType::kHalf ? countPast(channels, count) : 0;
}

struct Work {
    const Rgb* colors;
    std::size_t lines;
    std::size_t width;
    PixelType type;
    PackedLines place;
};

[[gnu::always_inline]] inline std::uint64_t packAll(const Work& w) {
    std::uint64_t cut = 0;
    const std::size_t bytes = bytesOf(w.type);
    for (std::size_t line = 0; line < w.lines; ++line) {
        char* out = w.place.begin + line * w.place.lineStride;
        for (std::size_t x = 0; x < w.width; x += kPiece) {
            cut += packPiece(w.colors + line * w.width + x, std::min(kPiece, w.width - x), w.type,
                             out + x * bytes, w.place.channelStride);
        }
    }
    return cut;
}

[[gnu::always_inline]] inline std::uint64_t halfsOf(const Rgb* colors, std::size_t count,
                                                    std::uint16_t* halfs) {
    const float* values = &colors->r;
    std::uint32_t past = 0;
    for (std::size_t i = 0; i < 3 * count; ++i) {
        halfs[i] = halfBits(values[i]);
        past += std::fabs(values[i]) <= kLargestHalf ? 0U : 1U;
    }
    if (past == 0) return 0;
    return static_cast<std::uint64_t>(std::count_if(colors, colors + count, [](const Rgb& c) {
        return !(std::max({std::fabs(c.r), std::fabs(c.g), std::fabs(c.b)}) <= kLargestHalf);
    }));
}

// The same loops for the registers that a processor has.
[[gnu::target("avx512f,avx512bw,avx512vl,avx512dq")]] std::uint64_t packAvx512(const Work& work) {
    return packAll(work);
}
[[gnu::target("avx2")]] std::uint64_t packAvx2(const Work& work) {
    return packAll(work);
}
std::uint64_t packPortable(const Work& work) {
    return packAll(work);
}

[[gnu::target("avx512f,avx512bw,avx512vl,avx512dq")]] std::uint64_t halfsAvx512(
    const Rgb* colors, std::size_t count, std::uint16_t* halfs) {
    return halfsOf(colors, count, halfs);
}
[[gnu::target("avx2")]] std::uint64_t halfsAvx2(const Rgb* colors, std::size_t count,
                                                std::uint16_t* halfs) {
    return halfsOf(colors, count, halfs);
}
std::uint64_t halfsPortable(const Rgb* colors, std::size_t count, std::uint16_t* halfs) {
    return halfsOf(colors, count, halfs);
}

}  // namespace

std::uint64_t packLines(const Rgb* colors, std::size_t lines, std::size_t width, PixelType type,
                        const PackedLines& place) {
    return forRegisters(packAvx512, packAvx2, packPortable)({colors, lines, width, type, place});
}

std::uint64_t halfsFrom(const Rgb* colors, std::size_t count, std::uint16_t* halfs) {
    return forRegisters(halfsAvx512, halfsAvx2, halfsPortable)(colors, count, halfs);
}

}  // namespace abrdf
