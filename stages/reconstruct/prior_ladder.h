// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/display_difference.h"
#include "abrdf/texel_model.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// Outputs at which models are compared, spread evenly over `pairs`, or over their weights where
/// there are any.
std::vector<std::size_t> probesOf(std::size_t pairs, std::span<const double> weights = {});

/// What a ladder is made of.
struct LadderParts {
    TexelModel leaveOut;     ///< Each sample from the others, of whole codes.
    TexelModel wholeProbes;  ///< The whole model at the probes, of whole codes; may be empty.
    TexelModel probes;       ///< The same of projected codes.
    std::vector<double> sampleCosines;  ///< cos(theta_i) of each sample.
    std::vector<float> sampleShares;    ///< As outputShares().
    float exposure = 1;
    float errorScale = 1;  ///< True errors beside left-out ones.
    float tolerance = 0;   ///< Mean CIE 1976 Delta E that is good enough; 0: take the largest.
    /// The models, the smallest first; the last is the largest there is.
    std::vector<std::uint16_t> ranks;
};

/// How well texels are known, and the smallest models that are good enough. By their samples alone:
/// what these say of one another when each is left out, and what a small model leaves out of the
/// whole one (design: estimator.md, 8).
class PriorLadder {
  public:
    PriorLadder() = default;
    explicit PriorLadder(LadderParts parts);

    const std::vector<std::uint16_t>& ranks() const { return parts_.ranks; }

    /// A bound of each texel's error by what its samples say of one another. whole: codes of whole
    /// rank; samples: theirs.
    std::vector<float> leftOutErrors(const TexelCodes& whole, std::span<const Rgb> samples) const;

    /// Sets the projected codes' ranks (and what a constant one needs) and the bound with what
    /// these leave out. whole, projected: codes of the same texels; there are probes.
    void choose(const TexelCodes& whole, TexelCodes& projected, std::span<const Rgb> samples,
                std::span<float> deltaE) const;

    /// Of a texel whose model is the `step`-th.
    double multiplyAdds(std::size_t step) const;

  private:
    /// rho of Lambert's law by least squares: sum(B cos) / sum(cos^2).
    Rgb lambertColor(std::span<const Rgb> samples) const;

    LadderParts parts_;
    std::vector<float> lambertWeights_;
};

}  // namespace abrdf
