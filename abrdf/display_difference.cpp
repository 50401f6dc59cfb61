// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/display_difference.h"

#include "abrdf/portable_vector.h"
#include "abrdf/register_bytes.h"

#include <algorithm>

namespace abrdf {

namespace {

constexpr std::size_t kPiece = 128;  // Colours at once: they stay in the innermost cache.

template <std::size_t kBytes>
using Vector = portable::Vector<kBytes>;

/// To 0 .. 1. Not a lambda, here and below: one is not inlined where nothing is optimised, and
/// then returns its value as processors without such registers do.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> clipped(const Vector<kBytes>& x) {
    return smaller(Vector<kBytes>::all(1), larger(Vector<kBytes>::all(0), x));
}

/// displayLab()'s curve.
template <std::size_t kBytes>
[[gnu::always_inline]] inline Vector<kBytes> curve(const Vector<kBytes>& t) {
    constexpr float kKnee = 216.0F / 24389.0F;
    const Vector<kBytes> knee = Vector<kBytes>::all(kKnee);
    const Vector<kBytes> third{log(larger(t, knee)).v * (1.0F / 3)};
    return {t.v > knee.v ? exp(third).v : t.v * (841.0F / 108) + 4.0F / 29};
}

/// displayLab() of as many colours as there are numbers in registers of so many bytes; in place.
template <std::size_t kBytes>
[[gnu::always_inline]] inline void labsOf(float* first, float* second, float* third) {
    using V = Vector<kBytes>;
    const V r = clipped(V::at(first));
    const V g = clipped(V::at(second));
    const V b = clipped(V::at(third));
    const V x = curve(V{(0.4124F * r.v + 0.3576F * g.v + 0.1805F * b.v) / 0.9505F});
    const V y = curve(V{0.2126F * r.v + 0.7152F * g.v + 0.0722F * b.v});
    const V z = curve(V{(0.0193F * r.v + 0.1192F * g.v + 0.9505F * b.v) / 1.0890F});
    V{116 * y.v - 16}.store(first);
    V{500 * (x.v - y.v)}.store(second);
    V{200 * (y.v - z.v)}.store(third);
}

template <std::size_t kBytes>
[[gnu::always_inline]] inline void allLabs(const Rgb* colors, std::size_t count, float exposure,
                                           DisplayLab* labs) {
    float planes[3][kPiece] = {};
    for (std::size_t first = 0; first < count; first += kPiece, colors += kPiece, labs += kPiece) {
        const std::size_t n = std::min(kPiece, count - first);
        for (std::size_t i = 0; i < n; ++i) {
            planes[0][i] = exposure * colors[i].r;
            planes[1][i] = exposure * colors[i].g;
            planes[2][i] = exposure * colors[i].b;
        }
        for (std::size_t i = 0; i < n; i += Vector<kBytes>::kCount) {
            labsOf<kBytes>(planes[0] + i, planes[1] + i, planes[2] + i);
        }
        for (std::size_t i = 0; i < n; ++i) labs[i] = {planes[0][i], planes[1][i], planes[2][i]};
    }
}

// The same loops for the registers that a processor has.
[[gnu::target("avx512f,avx512bw,avx512vl,avx512dq")]] void labsAvx512(const Rgb* colors,
                                                                      std::size_t count,
                                                                      float exposure,
                                                                      DisplayLab* labs) {
    allLabs<64>(colors, count, exposure, labs);
}
[[gnu::target("avx2")]] void labsAvx2(const Rgb* colors, std::size_t count, float exposure,
                                      DisplayLab* labs) {
    allLabs<32>(colors, count, exposure, labs);
}
void labsPortable(const Rgb* colors, std::size_t count, float exposure, DisplayLab* labs) {
    allLabs<16>(colors, count, exposure, labs);
}

}  // namespace

void displayLabs(const Rgb* colors, std::size_t count, float exposure, DisplayLab* labs) {
    forRegisters(labsAvx512, labsAvx2, labsPortable)(colors, count, exposure, labs);
}

}  // namespace abrdf
