// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace abrdf {

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
    const std::size_t own = samples.size() / texels;
    const std::size_t pairs = abrdfs.size() / texels;
    for (std::size_t t = 0; t < texels; ++t) {
        makeLights(abrdfs.subspan(t * pairs, pairs), mostOfSamples(samples.subspan(t * own, own)),
                   counts);
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
