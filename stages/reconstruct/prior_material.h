// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/texel_model.h"
#include "color/rgb.h"
#include "stages/reconstruct/code_projection.h"
#include "stages/reconstruct/prior_encoder.h"
#include "stages/reconstruct/prior_fit.h"
#include "stages/reconstruct/prior_ladder.h"
#include "stages/reconstruct/reconstructor.h"
#include "stages/reconstruct/whole_maps.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// The prior fitted to one material: fixed matrices for luminance and chroma of its texels, whole
/// or through few numbers.
class PriorMaterial {
  public:
    /// mean, texels: as fitPrior(); rowOf: as wholeMaps().
    PriorMaterial(const PriorModel& model, std::span<const std::size_t> rowOf,
                  std::span<const Rgb> mean, const ReconstructOptions& options,
                  std::span<const Rgb> texels = {});

    /// As Reconstructor::reconstruct(), for any number of texels.
    void reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const;

    /// Texels as numbers of model(), each of its own rank; deltaE: as
    /// Reconstructor::reconstructKnowing(), or empty.
    TexelCodes encode(std::span<const Rgb> samples, std::span<float> deltaE = {}) const;
    const TexelModel& model() const { return model_; }

    /// The ranks that texels may have, the largest last.
    const std::vector<std::uint16_t>& ranks() const { return ladder_.ranks(); }

    /// Of a texel of the largest rank.
    double multiplyAdds() const;
    double modelBytes() const { return model_.bytes(model_.columns()); }

    /// Of a texel of this rank, with what it takes to find that out.
    double multiplyAddsOfRank(std::uint16_t rank) const;

    const std::vector<PriorTerm>& terms() const { return terms_; }

    /// As PriorFit's.
    double leaveOneOutError() const { return leaveOneOutError_; }
    double shownExposure() const { return shownExposure_; }

  private:
    void buildModel(const PriorModel& model, const PriorFit& fit, const WholeMaps& whole,
                    const ReconstructOptions& options);

    std::vector<PriorTerm> terms_;
    bool isAlone_ = false;  ///< Are there no texels but the centre?
    PriorEncoder encoder_;
    CodeProjection projection_;
    TexelModel model_;
    PriorLadder ladder_;
    double leaveOneOutError_ = 0;
    double shownExposure_ = 1;
};

}  // namespace abrdf
