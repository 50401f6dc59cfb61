// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <atomic>

namespace abrdf {

namespace {

struct Faults {
    std::uint64_t clamped = 0;
    std::uint64_t nonfinite = 0;
    std::uint64_t dimmed = 0;
};

float largestChannel(std::span<const Rgb> samples) {
    float largest = 0;
    for (const Rgb& c : samples) largest = std::max({largest, c.r, c.g, c.b});
    return largest;
}

/// Makes lights of a texel's values: none unreal, negative or above `most`.
void makeLights(std::span<Rgb> values, float most, Faults& faults) {
    for (Rgb& value : values) {
        const float largest = std::max({value.r, value.g, value.b});
        if (value.r >= 0 && value.g >= 0 && value.b >= 0 && largest <= most) continue;
        if (!isFinite(value)) {
            ++faults.nonfinite;
            value = {};
            continue;
        }
        if (value.r < 0 || value.g < 0 || value.b < 0) {
            ++faults.clamped;
            value = {std::max(value.r, 0.0F), std::max(value.g, 0.0F), std::max(value.b, 0.0F)};
        }
        if (largest > most) {
            ++faults.dimmed;
            value *= most / largest;
        }
    }
}

}  // namespace

ReconstructedTexels reconstructTexels(const AbrdfTile& samples, const AngularGrid& output,
                                      const Reconstructor& reconstructor) {
    ReconstructedTexels result{AbrdfTile(samples.texelCount(), output.pairCount()), 0, 0, 0};
    std::atomic<std::uint64_t> clamped = 0;
    std::atomic<std::uint64_t> nonfinite = 0;
    std::atomic<std::uint64_t> dimmed = 0;
    forEachTexelBlock(samples.texelCount(), reconstructor.texelsAtOnce(),
                      [&](std::size_t begin, std::size_t end) {
                          const std::size_t pairs = output.pairCount();
                          const std::size_t count = samples.valuesPerTexel();
                          const std::span<Rgb> abrdfs =
                              result.abrdfs.values().subspan(begin * pairs, (end - begin) * pairs);
                          reconstructor.reconstruct(
                              samples.values().subspan(begin * count, (end - begin) * count),
                              abrdfs);
                          Faults faults;
                          for (std::size_t texel = begin; texel < end; ++texel) {
                              makeLights(result.abrdfs[texel],
                                         kMostOfSamples * largestChannel(samples[texel]), faults);
                          }
                          clamped += faults.clamped;
                          nonfinite += faults.nonfinite;
                          dimmed += faults.dimmed;
                      });
    result.clamped = clamped;
    result.nonfinite = nonfinite;
    result.dimmed = dimmed;
    return result;
}

}  // namespace abrdf
