// SPDX-License-Identifier: BSD-3-Clause
//
// `prior`: the conditional mean of log luminance under what random materials show, chroma by
// kriging (design: estimator.md, 2). Class and kernel are chosen once a material, by some of its
// texels; a texel then costs a few products with fixed matrices.
#include "abrdf/pair_features.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/reconstruct/reconstructor.h"

#include <stdexcept>

namespace abrdf {

namespace {

class Prior : public Reconstructor {
  public:
    explicit Prior(const ReconstructionTask& task)
        : model_(task.prior),
          options_(task.options),
          rowOf_(distinctPairs(pairsOf(task.output)).rowOf),
          material_(*task.prior, rowOf_, task.mean, options_, task.someTexels) {}

    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const override {
        if (options_.perTexel) {
            PriorMaterial(*model_, rowOf_, samples, options_).reconstruct(samples, abrdfs);
        } else {
            material_.reconstruct(samples, abrdfs);
        }
    }

    std::size_t texelsAtOnce() const override { return options_.perTexel ? 1 : 32; }
    double multiplyAdds() const override { return material_.multiplyAdds(); }
    double modelBytes() const override { return material_.modelBytes(); }

  private:
    std::shared_ptr<const PriorModel> model_;
    ReconstructOptions options_;
    std::vector<std::size_t> rowOf_;
    PriorMaterial material_;
};

}  // namespace

std::unique_ptr<Reconstructor> makePrior(const ReconstructionTask& task) {
    if (!task.prior || task.prior->samples.size() != task.samples.count() ||
        task.prior->outputs.size() != distinctPairs(pairsOf(task.output)).distinct.size()) {
        throw std::invalid_argument(
            "the prior's model is of another plan or grid than the job's; train one for it");
    }
    return std::make_unique<Prior>(task);
}

}  // namespace abrdf
