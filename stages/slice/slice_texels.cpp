// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/slice_texels.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <atomic>

namespace abrdf {

TexelSlicer::TexelSlicer(std::span<const std::size_t> images, const SampleSet& set)
    : images_(images.size()), directions_(set.directions), terms_(set.count()) {
    for (std::size_t k = 0; k < set.count(); ++k) {
        for (const WeightedPair& source : set.sources[k]) {
            const auto place = std::ranges::lower_bound(images, source.pair);
            terms_[k].push_back({static_cast<std::size_t>(place - images.begin()), source.weight});
        }
    }
}

std::uint64_t TexelSlicer::slice(std::span<const Rgb> band, std::size_t first,
                                 std::span<Rgb> samples) const {
    const std::size_t width = band.size() / images_;
    const std::size_t count = terms_.size();
    const std::size_t texels = samples.size() / count;
    // Texels of a block share the cache lines of every image that they touch.
    constexpr std::size_t kBlock = 32;
    for (std::size_t begin = 0; begin < texels; begin += kBlock) {
        const std::size_t end = std::min(texels, begin + kBlock);
        for (std::size_t k = 0; k < count; ++k) {
            for (std::size_t t = begin; t < end; ++t) samples[t * count + k] = {};
            for (const Term& term : terms_[k]) {
                const auto image = band.subspan(term.image * width + first, texels);
                for (std::size_t t = begin; t < end; ++t) {
                    samples[t * count + k] += term.weight * image[t];
                }
            }
        }
    }
    std::uint64_t repaired = 0;
    for (std::size_t t = 0; t < texels; ++t) repaired += repair(samples.subspan(t * count, count));
    return repaired;
}

/// Replaces invalid samples of one texel; rare, so slow and simple.
std::uint64_t TexelSlicer::repair(std::span<Rgb> samples) const {
    const auto isInvalid = [](const Rgb& c) { return !isFinite(c); };
    if (std::ranges::none_of(samples, isInvalid)) return 0;
    const std::vector<Rgb> measured(samples.begin(), samples.end());
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (isFinite(measured[k])) continue;
        ++count;
        samples[k] = {};
        double best = 1e9;
        for (std::size_t other = 0; other < measured.size(); ++other) {
            if (!isFinite(measured[other])) continue;
            const double distance = squaredDistance(directions_[k], directions_[other]);
            if (distance < best) {
                best = distance;
                samples[k] = measured[other];
            }
        }
    }
    return count;
}

SlicedTexels sliceTexels(const ImageStack& stack, const SampleSet& set, std::size_t firstTexel,
                         std::size_t texelCount) {
    constexpr std::size_t kBlock = 32;
    const TexelSlicer slicer(stack.pairs(), set);
    SlicedTexels result{AbrdfTile(texelCount, set.count()), 0};
    std::atomic<std::uint64_t> repaired = 0;
    forEachTexelBlock(texelCount, kBlock, [&](std::size_t begin, std::size_t end) {
        repaired += slicer.slice(
            stack.values(), firstTexel + begin,
            result.samples.values().subspan(begin * set.count(), (end - begin) * set.count()));
    });
    result.repaired = repaired;
    return result;
}

}  // namespace abrdf
