// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_colors.h"

#include "abrdf/portable_math.h"
#include "abrdf/portable_vector.h"
#include "abrdf/register_bytes.h"

#include <algorithm>
#include <limits>

namespace abrdf {

namespace {

constexpr float kLeastChannel = 1e-9F;
constexpr float kLeastSum = 1e-30F;
constexpr std::size_t kPiece = 256;  // Rows at once: they stay in the innermost cache.

template <std::size_t kBytes>
using Vector = portable::Vector<kBytes>;

template <std::size_t kBytes>
struct Channels {
    Vector<kBytes> r, g, b;
};

/// The first `kLogs` of luminance, R, G and B, each times its unit.
template <std::size_t kBytes, std::size_t kLogs>
[[gnu::always_inline]] inline void takeLights(const TexelRows& rows, std::size_t row,
                                              Vector<kBytes> (&lights)[kLogs]) {
    using V = Vector<kBytes>;
    const float units[] = {rows.luminance, rows.channel.r, rows.channel.g, rows.channel.b};
    // Both bounds from above at once.
    const V cap = V::all(std::min(rows.cap, portable::kLargestExponent));
    for (std::size_t i = 0; i < kLogs; ++i) {
        const V x{V::at(rows.logs[i] + row).v + V::at(rows.logCenters[i] + row).v};
        lights[i] = larger(smaller(x, cap), V::all(portable::kLeastExponent));
    }
    takeBoundedExp(lights);
    for (std::size_t i = 0; i < kLogs; ++i) {
        lights[i].v = larger(V{lights[i].v - rows.floor}, V::all(0)).v * units[i];
    }
}

/// Not negative; 0 where the channel's scale is.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> bounded(const Vector<kBytes>& x, float scale) {
    using V = Vector<kBytes>;
    const V most = V::all(scale > 0 ? std::numeric_limits<float>::max() : 0);
    return smaller(larger(x, V::all(0)), most);
}

/// `share` of a chroma that sums to 3, none of it negative; channels of scale 0 are black.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Channels<kBytes> normalized(const TexelRows& rows,
                                                          const Channels<kBytes>& chroma,
                                                          float share) {
    using V = Vector<kBytes>;
    const V r = bounded(chroma.r, rows.channel.r);
    const V g = bounded(chroma.g, rows.channel.g);
    const V b = bounded(chroma.b, rows.channel.b);
    const auto scale = 3 / larger(V{r.v + g.v + b.v}, V::all(kLeastSum)).v;
    return {{share * (scale * r.v)}, {share * (scale * g.v)}, {share * (scale * b.v)}};
}

template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> kriged(const TexelRows& rows, std::size_t channel,
                                                    std::size_t row) {
    using V = Vector<kBytes>;
    return {rows.meanChroma[channel] + V::at(rows.chromaCenters[channel] + row).v +
            V::at(rows.chroma[channel] + row).v};
}

/// The colours of as many rows as a register has numbers, each channel by itself. kLogs: 4 where
/// chroma of channels has a share, else 1.
template <std::size_t kBytes, std::size_t kLogs>
[[gnu::always_inline]] inline Channels<kBytes> colorsAt(const TexelRows& rows, std::size_t row) {
    Vector<kBytes> lights[kLogs];
    takeLights(rows, row, lights);
    Channels<kBytes> sum{};
    if (rows.blend < 1) {
        const Vector<kBytes> r = kriged<kBytes>(rows, 0, row);
        const Vector<kBytes> g = kriged<kBytes>(rows, 1, row);
        sum = normalized(rows, Channels<kBytes>{r, g, {3 - r.v - g.v}}, 1 - rows.blend);
    }
    if constexpr (kLogs == 4) {
        const Vector<kBytes> least = Vector<kBytes>::all(kLeastChannel);
        const Channels<kBytes> chroma = {larger(lights[1], least), larger(lights[2], least),
                                         larger(lights[3], least)};
        const Channels<kBytes> own = normalized(rows, chroma, rows.blend);
        sum = {{sum.r.v + own.r.v}, {sum.g.v + own.g.v}, {sum.b.v + own.b.v}};
    }
    return {{lights[0].v * sum.r.v}, {lights[0].v * sum.g.v}, {lights[0].v * sum.b.v}};
}

template <std::size_t kBytes, std::size_t kLogs>
[[gnu::always_inline]] inline void colorsOfWhole(const TexelRows& rows, std::size_t count,
                                                 Rgb* colors) {
    float planes[3][kPiece];
    for (std::size_t first = 0; first < count; first += kPiece) {
        const std::size_t n = std::min(kPiece, count - first);
        for (std::size_t i = 0; i < n; i += Vector<kBytes>::kCount) {
            const Channels<kBytes> c = colorsAt<kBytes, kLogs>(rows, first + i);
            c.r.store(planes[0] + i);
            c.g.store(planes[1] + i);
            c.b.store(planes[2] + i);
        }
        Rgb* out = colors + first;
        for (std::size_t i = 0; i < n; ++i) out[i] = {planes[0][i], planes[1][i], planes[2][i]};
    }
}

template <std::size_t kBytes>
[[gnu::always_inline]] inline void allColors(const TexelRows& rows, std::size_t count,
                                             Rgb* colors) {
    const std::size_t whole = count - count % Vector<kBytes>::kCount;
    if (rows.blend > 0) {
        colorsOfWhole<kBytes, 4>(rows, whole, colors);
    } else {
        colorsOfWhole<kBytes, 1>(rows, whole, colors);
    }
    for (std::size_t row = whole; row < count; ++row) colors[row] = slowTexelColor(rows, row);
}

// The same loops for the registers that a processor has.
[[gnu::target("avx512f,avx512bw,avx512vl,avx512dq")]] void colorsAvx512(const TexelRows& rows,
                                                                        std::size_t count,
                                                                        Rgb* colors) {
    allColors<64>(rows, count, colors);
}
[[gnu::target("avx2")]] void colorsAvx2(const TexelRows& rows, std::size_t count, Rgb* colors) {
    allColors<32>(rows, count, colors);
}
void colorsPortable(const TexelRows& rows, std::size_t count, Rgb* colors) {
    allColors<16>(rows, count, colors);
}

// Of a NaN, the second, as vectors do.
float larger(float a, float b) {
    return a > b ? a : b;
}
float smaller(float a, float b) {
    return a < b ? a : b;
}

Rgb slowNormalized(Rgb chroma, Rgb scale) {
    const Rgb bounded = {scale.r > 0 ? larger(chroma.r, 0.0F) : 0,
                         scale.g > 0 ? larger(chroma.g, 0.0F) : 0,
                         scale.b > 0 ? larger(chroma.b, 0.0F) : 0};
    return 3 / larger(bounded.r + bounded.g + bounded.b, kLeastSum) * bounded;
}

}  // namespace

void texelColors(const TexelRows& rows, std::size_t count, Rgb* colors) {
    forRegisters(colorsAvx512, colorsAvx2, colorsPortable)(rows, count, colors);
}

Rgb slowTexelColor(const TexelRows& rows, std::size_t row) {
    const auto light = [&](std::size_t i, float unit) {
        const float x = smaller(rows.logs[i][row] + rows.logCenters[i][row], rows.cap);
        return larger(portable::exp(x) - rows.floor, 0.0F) * unit;
    };
    Rgb chroma;
    if (rows.blend < 1) {
        const auto value = [&](std::size_t c) {
            return rows.meanChroma[c] + rows.chromaCenters[c][row] + rows.chroma[c][row];
        };
        const float r = value(0);
        const float g = value(1);
        chroma += (1 - rows.blend) * slowNormalized({r, g, 3 - r - g}, rows.channel);
    }
    if (rows.blend > 0) {
        chroma += rows.blend * slowNormalized({larger(light(1, rows.channel.r), kLeastChannel),
                                               larger(light(2, rows.channel.g), kLeastChannel),
                                               larger(light(3, rows.channel.b), kLeastChannel)},
                                              rows.channel);
    }
    return light(0, rows.luminance) * chroma;
}

}  // namespace abrdf
