// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/texel_colors.h"

#include "abrdf/portable_math.h"

#include <algorithm>
#include <limits>

namespace abrdf {

namespace {

constexpr float kLeastChannel = 1e-9F;
constexpr float kLeastSum = 1e-30F;
constexpr std::size_t kPiece = 256;  // Rows at once: they stay in the innermost cache.

// A comparison that picks one of two, not std::max(): what it makes of a NaN is one instruction's.
[[gnu::always_inline]] inline float larger(float a, float b) {
    return a > b ? a : b;
}
[[gnu::always_inline]] inline float smaller(float a, float b) {
    return a < b ? a : b;
}

/// Three channels of some rows, each for itself.
struct Planes {
    float r[kPiece];
    float g[kPiece];
    float b[kPiece];
};

[[gnu::always_inline]] inline void lights(const TexelRows& rows, std::size_t which, float unit,
                                          std::size_t first, std::size_t count, float* result) {
    const float* log = rows.logs[which] + first;
    const float* center = rows.logCenters[which] + first;
    const float cap = rows.cap;  // Not of `rows`, which the compiler cannot know to be apart.
    const float floor = rows.floor;
    for (std::size_t i = 0; i < count; ++i) {
        const float x = smaller(log[i] + center[i], cap);
        result[i] = larger(portable::exp(x) - floor, 0.0F) * unit;
    }
}

/// Chroma that sums to 3, none of it negative; channels of scale 0 are black. Added to `sum`.
[[gnu::always_inline]] inline void addNormalized(const TexelRows& rows, const Planes& chroma,
                                                 float share, std::size_t count, Planes& sum) {
    constexpr float kAny = std::numeric_limits<float>::max();
    const float mostR = rows.channel.r > 0 ? kAny : 0;
    const float mostG = rows.channel.g > 0 ? kAny : 0;
    const float mostB = rows.channel.b > 0 ? kAny : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float r = smaller(larger(chroma.r[i], 0.0F), mostR);
        const float g = smaller(larger(chroma.g[i], 0.0F), mostG);
        const float b = smaller(larger(chroma.b[i], 0.0F), mostB);
        const float scale = 3 / larger(r + g + b, kLeastSum);
        sum.r[i] += share * (scale * r);
        sum.g[i] += share * (scale * g);
        sum.b[i] += share * (scale * b);
    }
}

[[gnu::always_inline]] inline void kriged(const TexelRows& rows, std::size_t first,
                                          std::size_t count, Planes& chroma) {
    const float* r = rows.chroma[0] + first;
    const float* g = rows.chroma[1] + first;
    const float* centerR = rows.chromaCenters[0] + first;
    const float* centerG = rows.chromaCenters[1] + first;
    const auto [meanR, meanG] = rows.meanChroma;
    for (std::size_t i = 0; i < count; ++i) {
        chroma.r[i] = meanR + centerR[i] + r[i];
        chroma.g[i] = meanG + centerG[i] + g[i];
        chroma.b[i] = 3 - chroma.r[i] - chroma.g[i];
    }
}

[[gnu::always_inline]] inline void ofChannels(const TexelRows& rows, std::size_t first,
                                              std::size_t count, Planes& chroma) {
    lights(rows, 1, rows.channel.r, first, count, chroma.r);
    lights(rows, 2, rows.channel.g, first, count, chroma.g);
    lights(rows, 3, rows.channel.b, first, count, chroma.b);
    for (std::size_t i = 0; i < count; ++i) {
        chroma.r[i] = larger(chroma.r[i], kLeastChannel);
        chroma.g[i] = larger(chroma.g[i], kLeastChannel);
        chroma.b[i] = larger(chroma.b[i], kLeastChannel);
    }
}

[[gnu::always_inline]] inline void allColors(const TexelRows& rows, std::size_t count,
                                             Rgb* colors) {
    Planes chroma;
    Planes sum;
    float luminance[kPiece];
    for (std::size_t first = 0; first < count; first += kPiece, colors += kPiece) {
        const std::size_t n = std::min(kPiece, count - first);
        for (std::size_t i = 0; i < n; ++i) sum.r[i] = sum.g[i] = sum.b[i] = 0;
        if (rows.blend < 1) {
            kriged(rows, first, n, chroma);
            addNormalized(rows, chroma, 1 - rows.blend, n, sum);
        }
        if (rows.blend > 0) {
            ofChannels(rows, first, n, chroma);
            addNormalized(rows, chroma, rows.blend, n, sum);
        }
        lights(rows, 0, rows.luminance, first, n, luminance);
        for (std::size_t i = 0; i < n; ++i) {
            colors[i] = {luminance[i] * sum.r[i], luminance[i] * sum.g[i], luminance[i] * sum.b[i]};
        }
    }
}

// The same loops for the registers that a processor has.
[[gnu::target("avx512f,avx512bw,avx512vl,avx512dq")]] void colorsAvx512(const TexelRows& rows,
                                                                        std::size_t count,
                                                                        Rgb* colors) {
    allColors(rows, count, colors);
}
[[gnu::target("avx2")]] void colorsAvx2(const TexelRows& rows, std::size_t count, Rgb* colors) {
    allColors(rows, count, colors);
}
void colorsPortable(const TexelRows& rows, std::size_t count, Rgb* colors) {
    allColors(rows, count, colors);
}

bool hasAvx512() {
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0 && __builtin_cpu_supports("avx512dq") != 0;
}

Rgb slowNormalized(Rgb chroma, Rgb scale) {
    const Rgb bounded = {scale.r > 0 ? std::max(chroma.r, 0.0F) : 0,
                         scale.g > 0 ? std::max(chroma.g, 0.0F) : 0,
                         scale.b > 0 ? std::max(chroma.b, 0.0F) : 0};
    return 3 / std::max(bounded.r + bounded.g + bounded.b, kLeastSum) * bounded;
}

}  // namespace

void texelColors(const TexelRows& rows, std::size_t count, Rgb* colors) {
    static const auto kColors = hasAvx512()                           ? colorsAvx512
                                : __builtin_cpu_supports("avx2") != 0 ? colorsAvx2
                                                                      : colorsPortable;
    kColors(rows, count, colors);
}

Rgb slowTexelColor(const TexelRows& rows, std::size_t row) {
    const auto light = [&](std::size_t i, float unit) {
        const float x = std::min(rows.logs[i][row] + rows.logCenters[i][row], rows.cap);
        return std::max(portable::exp(x) - rows.floor, 0.0F) * unit;
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
        chroma += rows.blend * slowNormalized({std::max(light(1, rows.channel.r), kLeastChannel),
                                               std::max(light(2, rows.channel.g), kLeastChannel),
                                               std::max(light(3, rows.channel.b), kLeastChannel)},
                                              rows.channel);
    }
    return light(0, rows.luminance) * chroma;
}

}  // namespace abrdf
