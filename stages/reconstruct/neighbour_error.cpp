// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/neighbour_error.h"

#include "color/delta_e.h"
#include "stages/reconstruct/weighted_samples.h"

#include <algorithm>
#include <utility>

namespace abrdf {

namespace {

/// Of each sample, its nearest others and their weights, cosines taken out and put in.
std::vector<std::vector<SampleShare>> sharesOfOthers(const std::vector<LightAndView>& directions) {
    constexpr std::size_t kOthers = 4;
    constexpr double kSame = 1e-12;
    std::vector<std::vector<SampleShare>> shares;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        std::vector<std::pair<double, std::size_t>> nearest =
            nearestSamples(directions, directions[k], kOthers + 1);
        std::erase_if(nearest, [&](const auto& one) { return one.second == k; });
        double sum = 0;
        for (const auto& [distance, other] : nearest) sum += 1 / std::max(distance, kSame);
        std::vector<SampleShare>& own = shares.emplace_back();
        for (const auto& [distance, other] : nearest) {
            own.push_back({static_cast<std::uint32_t>(other),
                           static_cast<float>(boundedCosine(directions[k].light) /
                                              boundedCosine(directions[other].light) /
                                              std::max(distance, kSame) / sum)});
        }
    }
    return shares;
}

}  // namespace

std::vector<float> neighbourErrors(const std::vector<LightAndView>& directions,
                                   std::span<const Rgb> samples, double exposure) {
    const std::vector<std::vector<SampleShare>> shares = sharesOfOthers(directions);
    const auto e = static_cast<float>(exposure);
    std::vector<float> errors;
    for (std::size_t first = 0; first < samples.size(); first += directions.size()) {
        double sum = 0;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            Rgb predicted;
            for (const SampleShare& share : shares[k]) {
                predicted += share.weight * samples[first + share.sample];
            }
            sum += deltaE76(labFromLinearRec709(e * predicted),
                            labFromLinearRec709(e * samples[first + k]));
        }
        errors.push_back(static_cast<float>(sum / static_cast<double>(directions.size())));
    }
    return errors;
}

double neighbourError(const std::vector<LightAndView>& directions, std::span<const Rgb> samples,
                      double exposure) {
    const std::vector<float> errors = neighbourErrors(directions, samples, exposure);
    double sum = 0;
    for (const float error : errors) sum += static_cast<double>(error);
    return errors.empty() ? 0 : sum / static_cast<double>(errors.size());
}

}  // namespace abrdf
