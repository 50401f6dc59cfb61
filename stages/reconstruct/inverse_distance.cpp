// SPDX-License-Identifier: BSD-3-Clause
//
// `idw`: the four nearest samples (and those as near as the fourth), weighted by inverse squared
// distance over the unit vectors of both directions [Shepard 1968]: what renderers of BTFs do.
#include "stages/reconstruct/weighted_samples.h"

#include <algorithm>

namespace abrdf {

std::unique_ptr<Reconstructor> makeInverseDistance(const ReconstructionTask& task) {
    constexpr std::size_t kNeighbours = 4;
    constexpr double kSame = 1e-12;  // Squared distance of a pair that is a sample itself.
    std::vector<std::vector<SampleShare>> shares;
    for (const LightAndView& target : pairsOf(task.output)) {
        const auto nearest = nearestSamples(task.samples.directions, target, kNeighbours);
        double sum = 0;
        for (const auto& [distance, sample] : nearest) sum += 1 / std::max(distance, kSame);
        std::vector<SampleShare> own;
        for (const auto& [distance, sample] : nearest) {
            own.push_back({static_cast<std::uint32_t>(sample),
                           static_cast<float>(1 / std::max(distance, kSame) / sum)});
        }
        shares.push_back(std::move(own));
    }
    return std::make_unique<WeightedSamples>(task, std::move(shares));
}

}  // namespace abrdf
