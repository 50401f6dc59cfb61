// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "abrdf/texel_codes.h"
#include "color/rgb.h"
#include "stages/reconstruct/censored_samples.h"
#include "stages/reconstruct/prior_choice.h"
#include "stages/reconstruct/prior_chroma.h"
#include "stages/reconstruct/reconstructor.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// What the prior settles about a material by its samples alone, before it makes any map.
struct PriorFit {
    std::vector<PriorTerm> terms;             ///< The mixture of its luminance.
    std::optional<CensoredSamples> censored;  ///< Where samples may be clipped.
    Eigen::MatrixX3d mean;  ///< Its mean samples, a row each, with what was clipped put back.
    ChromaKriging kriging;
    TexelRule rule;  ///< How luminance and chroma make colours.

    /// Factor on the samples at which models are compared.
    double shownExposure = 1;
    /// Mean CIE 1976 Delta E of the samples against their predictions from one another, at
    /// shownExposure; over the texels of the choice.
    double leaveOneOutError = 0;
};

/// mean: the material's average samples, in the model's order; texels: samples of some texels, one
/// after the other, by which the models are chosen in place of the mean, which is smoother than
/// they are; may be empty. Of the options, noise and saturated are heeded.
PriorFit fitPrior(const PriorModel& model, std::span<const Rgb> mean, std::span<const Rgb> texels,
                  const ReconstructOptions& options);

}  // namespace abrdf
