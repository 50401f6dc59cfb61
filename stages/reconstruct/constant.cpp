// SPDX-License-Identifier: BSD-3-Clause
//
// `constant`: Lambert's law. One colour a texel times cos(theta_i), the least squares of its
// samples: rho = sum(B cos) / sum(cos^2).
#include "stages/reconstruct/reconstructor.h"

#include <cmath>

namespace abrdf {

namespace {

class Constant : public Reconstructor {
  public:
    explicit Constant(const ReconstructionTask& task) {
        double squares = 0;
        for (const LightAndView& pair : task.samples.directions) {
            squares += std::pow(std::cos(pair.light.theta), 2);
        }
        for (const LightAndView& pair : task.samples.directions) {
            weights_.push_back(static_cast<float>(std::cos(pair.light.theta) / squares));
        }
        for (const Direction& light : task.output.lights()) {
            cosines_.push_back(static_cast<float>(std::cos(light.theta)));
        }
        views_ = task.output.views().size();
    }

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const override {
        Rgb color;
        for (std::size_t k = 0; k < samples.size(); ++k) color += weights_[k] * samples[k];
        for (std::size_t pair = 0; pair < abrdf.size(); ++pair) {
            abrdf[pair] = cosines_[pair / views_] * color;
        }
    }

    double multiplyAdds() const override {
        return 3 * static_cast<double>(weights_.size() + cosines_.size() * views_);
    }

    double modelBytes() const override { return sizeof(Rgb); }

  private:
    std::vector<float> weights_;  ///< Of each sample.
    std::vector<float> cosines_;  ///< Of each light.
    std::size_t views_;
};

}  // namespace

std::unique_ptr<Reconstructor> makeConstant(const ReconstructionTask& task) {
    return std::make_unique<Constant>(task);
}

}  // namespace abrdf
