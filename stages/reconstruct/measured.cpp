// SPDX-License-Identifier: BSD-3-Clause
//
// `measured`: no reconstruction. On the database's own grid its values as they are, on another
// one their interpolation along the rings.
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>

namespace abrdf {

namespace {

class Measured : public Reconstructor {
  public:
    explicit Measured(const ReconstructionTask& task) : samples_(task.samples.count()) {
        if (task.input == task.output) return;
        const AngularInterpolation lights(task.input.lights());
        const AngularInterpolation views(task.input.views());
        for (std::size_t pair = 0; pair < task.output.pairCount(); ++pair) {
            weights_.push_back(pairWeights(task.input, lights, views, task.output.pair(pair)));
        }
    }

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const override {
        if (weights_.empty()) {
            std::ranges::copy(samples, abrdf.begin());
            return;
        }
        for (std::size_t pair = 0; pair < abrdf.size(); ++pair) {
            abrdf[pair] = {};
            for (const WeightedPair& term : weights_[pair]) {
                abrdf[pair] += term.weight * samples[term.pair];
            }
        }
    }

    double multiplyAdds() const override {
        double terms = 0;
        for (const auto& weights : weights_) terms += static_cast<double>(weights.size());
        return 3 * terms;
    }

    double modelBytes() const override { return static_cast<double>(samples_ * sizeof(Rgb)); }

  private:
    std::size_t samples_;
    std::vector<std::vector<WeightedPair>>
        weights_;  ///< Of each output pair; empty: the same grid.
};

}  // namespace

std::unique_ptr<Reconstructor> makeMeasured(const ReconstructionTask& task) {
    return std::make_unique<Measured>(task);
}

}  // namespace abrdf
