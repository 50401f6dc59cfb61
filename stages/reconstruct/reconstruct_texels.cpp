// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace abrdf {

namespace {

float largestChannel(std::span<const Rgb> samples) {
    float largest = 0;
    for (const Rgb& c : samples) largest = std::max({largest, c.r, c.g, c.b});
    return largest;
}

/// True where all lie in 0 .. most; without a branch, so that compilers make vectors of it.
bool areLights(std::span<const Rgb> values, float most) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const float* channels = &values.front().r;
    int others = 0;
    for (std::size_t i = 0; i < 3 * values.size(); ++i) {
        const auto notNegative = static_cast<int>(channels[i] >= 0);
        others += 1 - (notNegative & static_cast<int>(channels[i] <= most));
    }
    return others == 0;
}

/// Makes lights of values: none unreal, negative or above `most`.
void makeLights(std::span<Rgb> values, float most, UnrealCounts& counts) {
    for (Rgb& value : values) {
        if (!isFinite(value)) {
            ++counts.nonfinite;
            value = {};
            continue;
        }
        if (isNegative(value)) {
            ++counts.clamped;
            value = {std::max(value.r, 0.0F), std::max(value.g, 0.0F), std::max(value.b, 0.0F)};
        }
        const float largest = std::max({value.r, value.g, value.b});
        if (largest > most) {
            ++counts.dimmed;
            value *= most / largest;
        }
    }
}

}  // namespace

void Reconstructor::reconstructKnowing(std::span<const Rgb> samples, std::span<Rgb> abrdfs,
                                       std::span<float> deltaE) const {
    reconstruct(samples, abrdfs);
    std::ranges::fill(deltaE, std::numeric_limits<float>::quiet_NaN());
}

UnrealCounts reconstructBlock(std::span<const Rgb> samples, std::size_t texels,
                              const Reconstructor& reconstructor, std::span<Rgb> abrdfs,
                              std::span<float> estimates) {
    if (estimates.empty()) {
        reconstructor.reconstruct(samples, abrdfs);
    } else {
        reconstructor.reconstructKnowing(samples, abrdfs, estimates);
    }
    UnrealCounts counts;
    constexpr std::size_t kPiece = 512;  // Looked at while it is in the innermost cache.
    const std::size_t own = samples.size() / texels;
    const std::size_t pairs = abrdfs.size() / texels;
    for (std::size_t t = 0; t < texels; ++t) {
        const float most = std::min(kMostOfSamples * largestChannel(samples.subspan(t * own, own)),
                                    std::numeric_limits<float>::max());
        for (std::size_t begin = 0; begin < pairs; begin += kPiece) {
            const auto piece = abrdfs.subspan(t * pairs + begin, std::min(kPiece, pairs - begin));
            if (!areLights(piece, most)) makeLights(piece, most, counts);
        }
    }
    return counts;
}

ReconstructedTexels reconstructTexels(const AbrdfTile& samples, const AngularGrid& output,
                                      const Reconstructor& reconstructor) {
    ReconstructedTexels result{AbrdfTile(samples.texelCount(), output.pairCount()), {}};
    result.estimates.resize(reconstructor.knowsError() ? samples.texelCount() : 0);
    std::atomic<std::uint64_t> clamped = 0;
    std::atomic<std::uint64_t> nonfinite = 0;
    std::atomic<std::uint64_t> dimmed = 0;
    const std::size_t pairs = output.pairCount();
    const std::size_t count = samples.valuesPerTexel();
    forEachTexelBlock(
        samples.texelCount(), reconstructor.texelsAtOnce(),
        [&](std::size_t begin, std::size_t end) {
            const std::size_t texels = end - begin;
            std::span<float> estimates = result.estimates;
            if (!estimates.empty()) estimates = estimates.subspan(begin, texels);
            const UnrealCounts counts = reconstructBlock(
                samples.values().subspan(begin * count, texels * count), texels, reconstructor,
                result.abrdfs.values().subspan(begin * pairs, texels * pairs), estimates);
            clamped += counts.clamped;
            nonfinite += counts.nonfinite;
            dimmed += counts.dimmed;
        });
    result.unreal = {clamped, nonfinite, dimmed};
    return result;
}

}  // namespace abrdf
