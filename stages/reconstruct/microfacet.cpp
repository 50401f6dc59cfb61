// SPDX-License-Identifier: BSD-3-Clause
//
// `microfacet`: what renderers hold of a material: a diffuse body and an anisotropic GGX lobe,
// fitted to each texel's samples.
#include "stages/reconstruct/microfacet_fit.h"
#include "stages/reconstruct/reconstructor.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

class Microfacet : public Reconstructor {
  public:
    explicit Microfacet(const ReconstructionTask& task) : samples_(task.samples.directions) {
        for (const LightAndView& pair : pairsOf(task.output)) {
            outputs_.emplace_back(Imath::V3f(vectorFromDirection(pair.light)),
                                  Imath::V3f(vectorFromDirection(pair.view)));
            cosines_.push_back(static_cast<float>(std::max(std::cos(pair.light.theta), 0.0)));
        }
    }

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdf) const override {
        const MicrofacetFit fit = fitMicrofacet(samples_, samples);
        const PreparedLobe lobe(fit.lobe());
        for (std::size_t pair = 0; pair < abrdf.size(); ++pair) {
            abrdf[pair] = cosines_[pair] *
                          (fit.diffuse + lobe.reflectanceFactor(outputs_[pair]) * fit.specular);
        }
    }

    double multiplyAdds() const override {
        // Lobes of about 40: three descents of some ten steps, six evaluations each.
        return 40 *
               (180 * static_cast<double>(samples_.size()) + static_cast<double>(outputs_.size()));
    }

    double modelBytes() const override { return 10 * sizeof(float); }

  private:
    std::vector<LightAndView> samples_;
    std::vector<LocalPair> outputs_;
    std::vector<float> cosines_;
};

}  // namespace

std::unique_ptr<Reconstructor> makeMicrofacet(const ReconstructionTask& task) {
    return std::make_unique<Microfacet>(task);
}

}  // namespace abrdf
