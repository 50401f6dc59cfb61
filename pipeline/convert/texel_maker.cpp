// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/texel_maker.h"

#include <algorithm>

namespace abrdf {

void TexelMaker::make(std::span<const Rgb> band, std::size_t first, std::size_t count,
                      Buffers& buffers) const {
    makeUnfinished(band, first, count, buffers);
    finisher.finish(buffers.abrdfs);
}

void TexelMaker::makeUnfinished(std::span<const Rgb> band, std::size_t first, std::size_t count,
                                Buffers& buffers) const {
    const std::size_t samples = slicer.sampleCount();
    const bool extends = !grazing.isIdentity();
    const std::size_t innerPairs = grazing.inner().pairCount();
    buffers.samples.resize(count * samples);
    buffers.abrdfs.resize(count * pairs);
    buffers.inner.resize(extends ? count * innerPairs : 0);
    buffers.estimates.resize(reconstructor.knowsError() ? count : 0);
    buffers.unreal = {};
    slicer.slice(band, first, buffers.samples);
    const std::span<Rgb> made = extends ? buffers.inner : buffers.abrdfs;
    const std::size_t atOnce = reconstructor.texelsAtOnce();
    for (std::size_t t = 0; t < count; t += atOnce) {
        const std::size_t n = std::min(atOnce, count - t);
        std::span<float> estimates = buffers.estimates;
        if (!estimates.empty()) estimates = estimates.subspan(t, n);
        buffers.unreal += reconstructBlock(
            std::span(buffers.samples).subspan(t * samples, n * samples), n, reconstructor,
            made.subspan(t * innerPairs, n * innerPairs), estimates);
    }
    const std::span<Rgb> abrdfs = buffers.abrdfs;
    for (std::size_t t = 0; extends && t < count; ++t) {
        grazing.apply(made.subspan(t * innerPairs, innerPairs), abrdfs.subspan(t * pairs, pairs));
    }
}

}  // namespace abrdf
