// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/texel_model.h"
#include "stages/reconstruct/censored_samples.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// A row a colour.
Eigen::MatrixX3d matrixOf(std::span<const Rgb> colors);

/// Samples of channel c with the floor that keeps zeros from being outliers of logarithms.
Eigen::VectorXd channelSamples(const Eigen::MatrixX3d& colors, Eigen::Index c);

/// Makes of texels' samples the vectors that the prior's maps take: logarithms of luminance and
/// channels relative to their scale, and chroma about its mean, each less a centre.
class PriorEncoder {
  public:
    /// What vectors are less, a number a sample.
    struct Centers {
        std::array<Eigen::VectorXf, 4> logs;    ///< Of luminance, R, G and B.
        std::array<Eigen::VectorXf, 2> chroma;  ///< Of R and G.
    };

    PriorEncoder() = default;
    /// scaleFactor: as PriorModel's; censored: where samples may be clipped.
    PriorEncoder(double scaleFactor, Centers centers, TexelRule rule,
                 std::optional<CensoredSamples> censored);

    /// What a material's own mean makes of itself, without a centre.
    static Centers centersOf(const Eigen::MatrixX3d& colors, double scaleFactor);

    const Centers& centers() const { return centers_; }

    /// Codes of whole rank, a number a sample, of any number of texels. restored: their samples,
    /// with what was clipped put back.
    TexelCodes encode(std::span<const Rgb> samples, std::vector<Rgb>& restored) const;

  private:
    void addTexel(const Eigen::MatrixX3d& colors, TexelCodes& codes) const;

    double scaleFactor_ = 1;
    Centers centers_;
    TexelRule rule_;
    std::optional<CensoredSamples> censored_;
};

}  // namespace abrdf
