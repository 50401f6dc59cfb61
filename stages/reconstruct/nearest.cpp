// SPDX-License-Identifier: BSD-3-Clause
//
// `nearest`: each output pair shows the sample whose two directions are nearest.
#include "stages/reconstruct/weighted_samples.h"

namespace abrdf {

std::unique_ptr<Reconstructor> makeNearest(const ReconstructionTask& task) {
    std::vector<std::vector<SampleShare>> shares;
    for (const LightAndView& target : pairsOf(task.output)) {
        const auto nearest = nearestSamples(task.samples.directions, target, 1);
        shares.push_back({{static_cast<std::uint32_t>(nearest[0].second), 1.0F}});
    }
    return std::make_unique<WeightedSamples>(task, std::move(shares));
}

}  // namespace abrdf
