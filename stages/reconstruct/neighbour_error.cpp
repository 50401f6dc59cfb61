// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/neighbour_error.h"

#include "color/delta_e.h"
#include "stages/reconstruct/weighted_samples.h"

#include <algorithm>

namespace abrdf {

double neighbourError(const std::vector<LightAndView>& directions, std::span<const Rgb> samples,
                      double exposure) {
    constexpr std::size_t kOthers = 4;
    constexpr double kSame = 1e-12;
    const auto e = static_cast<float>(exposure);
    double sum = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        Rgb predicted;
        double weights = 0;
        for (const auto& [distance, other] : nearestSamples(directions, directions[k], kOthers + 1)) {
            if (other == k) continue;
            const double weight = 1 / std::max(distance, kSame);
            weights += weight;
            predicted += static_cast<float>(weight / boundedCosine(directions[other].light)) *
                         samples[other];
        }
        if (weights > 0) {
            predicted *= static_cast<float>(boundedCosine(directions[k].light) / weights);
        }
        sum += deltaE76(labFromLinearRec709(e * predicted), labFromLinearRec709(e * samples[k]));
    }
    return directions.empty() ? 0 : sum / static_cast<double>(directions.size());
}

}  // namespace abrdf
