// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/reconstruct/reconstructor.h"

#include <cstdint>
#include <vector>

namespace abrdf {

/// A few samples and their shares in a value.
struct SampleShare {
    std::uint32_t sample = 0;
    float weight = 0;
};

/// cos(theta_i), kept away from 0, so that it can be divided by.
double boundedCosine(const Direction& light);

/// The `count` samples nearest to `target` as squared distances of pairs, the nearest first, and
/// those that are as near as the last of them: which of equals is taken must not depend on their
/// order.
std::vector<std::pair<double, std::size_t>> nearestSamples(const std::vector<LightAndView>& samples,
                                                           const LightAndView& target,
                                                           std::size_t count);

/// A method that mixes a few samples at each output pair. What is mixed is B / cos(theta_i), so
/// that a Lambertian comes back exactly.
class WeightedSamples : public Reconstructor {
  public:
    /// shares: of each output pair, weights that sum to 1; the cosines are added here.
    WeightedSamples(const ReconstructionTask& task, std::vector<std::vector<SampleShare>> shares);

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const override;
    double multiplyAdds() const override;
    double modelBytes() const override;

  private:
    std::size_t samples_;
    std::vector<SampleShare> shares_;  ///< Pair after pair.
    std::vector<std::size_t> ends_;    ///< Of each pair's shares.
};

}  // namespace abrdf
