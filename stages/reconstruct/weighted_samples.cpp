// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/weighted_samples.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

double boundedCosine(const Direction& light) {
    return std::max(std::cos(light.theta), 1e-3);
}

std::vector<std::pair<double, std::size_t>> nearestSamples(const std::vector<LightAndView>& samples,
                                                           const LightAndView& target,
                                                           std::size_t count) {
    std::vector<std::pair<double, std::size_t>> found;
    for (std::size_t k = 0; k < samples.size(); ++k) {
        found.emplace_back(squaredDistance(samples[k], target), k);
    }
    std::ranges::sort(found);
    constexpr double kEqual = 1e-9;
    std::size_t kept = std::min(count, found.size());
    const double last = found[kept - 1].first + kEqual;
    while (kept < found.size() && found[kept].first <= last) ++kept;
    found.resize(kept);
    return found;
}

WeightedSamples::WeightedSamples(const ReconstructionTask& task,
                                 std::vector<std::vector<SampleShare>> shares)
    : samples_(task.samples.count()) {
    for (std::size_t pair = 0; pair < shares.size(); ++pair) {
        const double cosine = boundedCosine(task.output.pair(pair).light);
        for (SampleShare share : shares[pair]) {
            const Direction& light = task.samples.directions[share.sample].light;
            share.weight *= static_cast<float>(cosine / boundedCosine(light));
            shares_.push_back(share);
        }
        ends_.push_back(shares_.size());
    }
}

void WeightedSamples::reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const {
    std::size_t next = 0;
    for (std::size_t pair = 0; pair < abrdf.size(); ++pair) {
        Rgb value;
        for (; next < ends_[pair]; ++next) {
            value += shares_[next].weight * samples[shares_[next].sample];
        }
        abrdf[pair] = value;
    }
}

double WeightedSamples::multiplyAdds() const {
    return 3 * static_cast<double>(shares_.size());
}

double WeightedSamples::modelBytes() const {
    return static_cast<double>(samples_ * sizeof(Rgb));
}

}  // namespace abrdf
