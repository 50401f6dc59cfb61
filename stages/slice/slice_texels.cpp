// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/slice_texels.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace abrdf {

namespace {

/// One term of a sample: which image of the stack, and its share.
struct Term {
    std::size_t image;
    float weight;
};

std::vector<std::vector<Term>> termsInStack(const ImageStack& stack, const SampleSet& set) {
    std::vector<std::vector<Term>> terms(set.count());
    for (std::size_t k = 0; k < set.count(); ++k) {
        for (const WeightedPair& source : set.sources[k]) {
            const auto place = std::ranges::lower_bound(stack.pairs(), source.pair);
            terms[k].push_back(
                {static_cast<std::size_t>(place - stack.pairs().begin()), source.weight});
        }
    }
    return terms;
}

/// Replaces invalid samples of one texel; rare, so slow and simple.
std::uint64_t repair(std::span<Rgb> samples, const SampleSet& set) {
    std::vector<std::size_t> invalid;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        if (!isFinite(samples[k])) invalid.push_back(k);
    }
    if (invalid.empty()) return 0;
    const std::vector<Rgb> measured(samples.begin(), samples.end());
    for (const std::size_t k : invalid) {
        samples[k] = {};
        double best = 1e9;
        for (std::size_t other = 0; other < measured.size(); ++other) {
            if (!isFinite(measured[other])) continue;
            const double distance = squaredDistance(set.directions[k], set.directions[other]);
            if (distance < best) {
                best = distance;
                samples[k] = measured[other];
            }
        }
    }
    return invalid.size();
}

}  // namespace

SlicedTexels sliceTexels(const ImageStack& stack, const SampleSet& set, std::size_t firstTexel,
                         std::size_t texelCount) {
    // Texels of a block share the cache lines of every image that they touch.
    constexpr std::size_t kBlock = 32;
    const std::vector<std::vector<Term>> terms = termsInStack(stack, set);
    SlicedTexels result{AbrdfTile(texelCount, set.count()), 0};
    std::atomic<std::uint64_t> repaired = 0;
    forEachTexelBlock(texelCount, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = 0; k < terms.size(); ++k) {
            for (const Term& term : terms[k]) {
                const auto image = stack.image(term.image).subspan(firstTexel, texelCount);
                for (std::size_t texel = begin; texel < end; ++texel) {
                    result.samples[texel][k] += term.weight * image[texel];
                }
            }
        }
        std::uint64_t count = 0;
        for (std::size_t t = begin; t < end; ++t) count += repair(result.samples[t], set);
        repaired += count;
    });
    result.repaired = repaired;
    return result;
}

}  // namespace abrdf
