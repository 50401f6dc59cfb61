// SPDX-License-Identifier: BSD-3-Clause
//
// `nearest`: each output pair shows the sample whose two directions are nearest, or the mean of
// those that are equally near.
#include "stages/reconstruct/weighted_samples.h"

namespace abrdf {

std::unique_ptr<Reconstructor> makeNearest(const ReconstructionTask& task) {
    std::vector<std::vector<SampleShare>> shares;
    for (const LightAndView& target : pairsOf(task.output)) {
        const auto nearest = nearestSamples(task.samples.directions, target, 1);
        std::vector<SampleShare> own;
        for (const auto& [distance, sample] : nearest) {
            own.push_back(
                {static_cast<std::uint32_t>(sample), 1.0F / static_cast<float>(nearest.size())});
        }
        shares.push_back(std::move(own));
    }
    return std::make_unique<WeightedSamples>(task, std::move(shares));
}

}  // namespace abrdf
