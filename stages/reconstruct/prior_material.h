// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/texel_model.h"
#include "color/rgb.h"
#include "stages/reconstruct/prior_chroma.h"
#include "stages/reconstruct/prior_encoder.h"
#include "stages/reconstruct/prior_ladder.h"
#include "stages/reconstruct/prior_map.h"
#include "stages/reconstruct/reconstructor.h"

#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// The prior fitted to one material: fixed matrices for luminance and chroma of its texels, whole
/// or through few numbers.
class PriorMaterial {
  public:
    /// mean: the material's average samples, in the model's order; rowOf: of each output, its place
    /// among the model's, which are distinct; texels: samples of some texels, one after the other,
    /// by which the models are chosen in place of the mean, which is smoother than they are.
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

    /// Mean CIE 1976 Delta E of the samples against their predictions from one another, at the
    /// exposure at which models are compared; over the texels of the choice.
    double leaveOneOutError() const { return leaveOneOutError_; }
    double shownExposure() const { return shownExposure_; }

  private:
    /// The whole maps from samples to rows; for a centre that is alone, of one column of zeros.
    struct Whole {
        Eigen::MatrixXf luminance;
        Eigen::MatrixXf chroma;
        TexelBasis centers;  ///< Its matrices are empty.
        std::vector<std::size_t> rowOf;
        std::vector<LightAndView> pairs;
    };

    std::vector<Eigen::MatrixX3d> chooseModels(const PriorModel& model, Eigen::MatrixX3d& colors,
                                               std::span<const Rgb> texels,
                                               const ReconstructOptions& options);
    float chosenBlend(const PriorModel& model, const std::vector<Eigen::MatrixX3d>& texels,
                      double shown, const std::vector<Eigen::MatrixX3d>& kriged);
    Whole wholeMaps(const PriorModel& model, std::span<const std::size_t> rowOf,
                    const Eigen::MatrixX3d& colors, const ChromaKriging& kriging) const;
    TexelCodes codesOfCenter(const TexelCodes& whole) const;
    void buildModel(const PriorModel& model, const ChromaKriging& kriging, Whole whole,
                    const ReconstructOptions& options);
    static Eigen::VectorXd rowWeights(const Whole& whole, std::span<const double> weights);
    TexelModel leaveOutModel(const PriorModel& model, const ChromaKriging& kriging) const;
    TexelCodes projected(const TexelCodes& whole) const;
    void cutToRanks(const TexelCodes& whole, TexelCodes& codes) const;
    double projectionCost() const;

    std::vector<PriorTerm> terms_;
    std::optional<CensoredSamples> censored_;  ///< Where samples may be clipped.
    TexelRule rule_;
    bool isAlone_ = false;  ///< Are there no texels but the centre?
    PriorEncoder encoder_;
    PackedMatrix luminanceProjection_;  ///< Without columns where codes stay whole.
    PackedMatrix chromaProjection_;
    TexelModel model_;
    PriorLadder ladder_;
    double leaveOneOutError_ = 0;
    double shownExposure_ = 1;
};

}  // namespace abrdf
