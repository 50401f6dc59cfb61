// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"
#include "stages/reconstruct/censored_samples.h"
#include "stages/reconstruct/low_rank.h"
#include "stages/reconstruct/prior_chroma.h"
#include "stages/reconstruct/prior_colors.h"
#include "stages/reconstruct/prior_map.h"
#include "stages/reconstruct/reconstructor.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// The prior fitted to one material: fixed matrices for luminance and chroma of its texels.
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

    double multiplyAdds() const;

    /// Of a texel's vectors in floats, when they are kept instead of its ABRDF.
    double modelBytes() const;

    const std::vector<PriorTerm>& terms() const { return terms_; }

    /// Mean CIE 1976 Delta E of the samples against their predictions from one another, at the
    /// exposure at which models are compared; over the texels of the choice.
    double leaveOneOutError() const { return leaveOneOutError_; }
    double shownExposure() const { return shownExposure_; }

  private:
    /// One texel's numbers beside its vectors.
    struct TexelScale {
        float luminance = 0;                ///< Scale of its luminance; 0: the texel is black.
        Rgb channel;                        ///< Of its channels; 0: that channel is black.
        std::array<float, 2> meanChroma{};  ///< Of R and G; all three sum to 3.
    };
    /// What the samples of several texels become: vectors for luminance_ and chroma_.
    struct Inputs {
        std::vector<TexelScale> scales;
        std::array<std::vector<float>, 4> logs;    ///< Of luminance, R, G and B.
        std::array<std::vector<float>, 2> chroma;  ///< Of R and G, about its mean.
    };
    struct Products;
    /// What a map makes of the material's mean: vectors enter it less `input`, results leave it
    /// with `output` added. A map of low rank is so exact for the mean.
    struct Center {
        std::vector<float> input;   ///< A number a sample.
        std::vector<float> output;  ///< A number a row.
    };

    std::vector<Eigen::MatrixX3d> chooseModels(const PriorModel& model, Eigen::MatrixX3d& colors,
                                               std::span<const Rgb> texels,
                                               const ReconstructOptions& options);
    void chooseBlend(const PriorModel& model, const std::vector<Eigen::MatrixX3d>& texels,
                     double shown, const std::vector<Eigen::MatrixX3d>& kriged);
    static Center centered(const Eigen::MatrixXf& matrix, const Eigen::VectorXf& input);
    void centerLogs(const PriorMap& map, const Eigen::MatrixX3d& colors);
    /// Lets vectors enter the maps as they are.
    void uncenter(const PriorMap& map);
    void addTexel(std::span<const Rgb> samples, Inputs& inputs) const;
    void multiply(const Inputs& inputs, std::size_t firstPanel, std::size_t panels,
                  Products& products) const;
    PriorRows rowsOf(const Products& products, const TexelScale& scale, std::size_t texel) const;

    double scaleFactor_;
    std::size_t sampleCount_;
    /// ln of the largest value relative to the scale: three times the largest samples, and a
    /// little room for a highlight between them.
    float cap_;
    std::vector<std::size_t> rowOf_;  ///< Of each output, its row of the maps.
    bool rowsArePairs_ = false;       ///< Is rowOf_[i] = i for all?
    std::vector<PriorTerm> terms_;
    std::optional<CensoredSamples> censored_;  ///< Where samples may be clipped.
    LowRankMatrix luminance_;
    LowRankMatrix chroma_;
    std::array<Center, 4> logCenters_;     ///< Of luminance, R, G and B.
    std::array<Center, 2> chromaCenters_;  ///< Of R and G.
    float blend_ = 0;  ///< Share of chroma from channels, beside chroma by kriging.
    double leaveOneOutError_ = 0;
    double shownExposure_ = 1;
};

}  // namespace abrdf
