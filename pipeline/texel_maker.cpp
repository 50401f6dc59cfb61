// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/texel_maker.h"

#include <algorithm>

namespace abrdf {

void TexelMaker::make(std::span<const Rgb> band, std::size_t first, std::size_t count,
                      Buffers& buffers) const {
    const std::size_t samples = slicer.sampleCount();
    buffers.samples.resize(count * samples);
    buffers.abrdfs.resize(count * pairs);
    buffers.unreal = {};
    slicer.slice(band, first, buffers.samples);
    const std::span<Rgb> abrdfs = buffers.abrdfs;
    const std::size_t atOnce = reconstructor.texelsAtOnce();
    for (std::size_t t = 0; t < count; t += atOnce) {
        const std::size_t n = std::min(atOnce, count - t);
        const UnrealCounts counts =
            reconstructBlock(std::span(buffers.samples).subspan(t * samples, n * samples),
                             reconstructor, abrdfs.subspan(t * pairs, n * pairs));
        buffers.unreal.clamped += counts.clamped;
        buffers.unreal.nonfinite += counts.nonfinite;
    }
    finisher.finish(abrdfs);
}

}  // namespace abrdf
