// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace abrdf {

namespace {

/// True where all are lights; without a branch, so that compilers make vectors of it.
bool areLights(std::span<const Rgb> values) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const float* channels = &values.front().r;
    constexpr float kMax = std::numeric_limits<float>::max();
    int others = 0;
    for (std::size_t i = 0; i < 3 * values.size(); ++i) {
        const auto notNegative = static_cast<int>(channels[i] >= 0);
        others += 1 - (notNegative & static_cast<int>(channels[i] <= kMax));
    }
    return others == 0;
}

}  // namespace

UnrealCounts reconstructBlock(std::span<const Rgb> samples, const Reconstructor& reconstructor,
                              std::span<Rgb> abrdfs) {
    reconstructor.reconstruct(samples, abrdfs);
    UnrealCounts counts;
    constexpr std::size_t kPiece = 512;  // Looked at while it is in the innermost cache.
    for (std::size_t begin = 0; begin < abrdfs.size(); begin += kPiece) {
        const auto piece = abrdfs.subspan(begin, std::min(kPiece, abrdfs.size() - begin));
        if (areLights(piece)) continue;
        for (Rgb& value : piece) {
            if (!isFinite(value)) {
                ++counts.nonfinite;
                value = {};
            } else if (isNegative(value)) {
                ++counts.clamped;
                value = {std::max(value.r, 0.0F), std::max(value.g, 0.0F), std::max(value.b, 0.0F)};
            }
        }
    }
    return counts;
}

ReconstructedTexels reconstructTexels(const AbrdfTile& samples, const AngularGrid& output,
                                      const Reconstructor& reconstructor) {
    ReconstructedTexels result{AbrdfTile(samples.texelCount(), output.pairCount()), 0, 0};
    std::atomic<std::uint64_t> clamped = 0;
    std::atomic<std::uint64_t> nonfinite = 0;
    const std::size_t pairs = output.pairCount();
    const std::size_t count = samples.valuesPerTexel();
    forEachTexelBlock(samples.texelCount(), reconstructor.texelsAtOnce(),
                      [&](std::size_t begin, std::size_t end) {
                          const UnrealCounts counts = reconstructBlock(
                              samples.values().subspan(begin * count, (end - begin) * count),
                              reconstructor,
                              result.abrdfs.values().subspan(begin * pairs, (end - begin) * pairs));
                          clamped += counts.clamped;
                          nonfinite += counts.nonfinite;
                      });
    result.clamped = clamped;
    result.nonfinite = nonfinite;
    return result;
}

}  // namespace abrdf
