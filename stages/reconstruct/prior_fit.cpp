// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_fit.h"

#include "abrdf/for_each_texel.h"
#include "stages/reconstruct/prior_encoder.h"

#include <array>
#include <cstddef>
#include <utility>

namespace abrdf {

namespace {

constexpr std::array kBlends = {0.0F, 0.25F, 0.5F, 0.75F, 1.0F};

/// A column a texel.
Eigen::MatrixXd luminancesOf(const std::vector<Eigen::MatrixX3d>& texels) {
    Eigen::MatrixXd luminances(texels.front().rows(), static_cast<Eigen::Index>(texels.size()));
    for (std::size_t t = 0; t < texels.size(); ++t) {
        luminances.col(static_cast<Eigen::Index>(t)) = texels[t].rowwise().sum() / 3;
    }
    return luminances;
}

/// A matrix a texel, each of `count` samples.
std::vector<Eigen::MatrixX3d> matricesOf(std::span<const Rgb> texels, std::size_t count) {
    std::vector<Eigen::MatrixX3d> matrices;
    for (std::size_t first = 0; first < texels.size(); first += count) {
        matrices.push_back(matrixOf(texels.subspan(first, count)));
    }
    return matrices;
}

struct Mixture {
    std::vector<PriorTerm> terms;
    std::optional<CensoredSamples> censored;
};

/// A first mixture puts back what was clipped, in `mean` and `texels`; by these texels it is then
/// chosen anew.
Mixture chooseMixture(const PriorModel& model, const ReconstructOptions& options,
                      Eigen::MatrixX3d& mean, std::vector<Eigen::MatrixX3d>& texels) {
    Mixture mixture{chooseTerms(model, luminancesOf(texels), options.noise), {}};
    if (options.saturated <= 0) return mixture;
    const CensoredSamples first(model, mixture.terms, options.saturated);
    mean = first.restored(mean);
    for (Eigen::MatrixX3d& texel : texels) texel = first.restored(texel);
    mixture.terms = chooseTerms(model, luminancesOf(texels), options.noise);
    mixture.censored.emplace(model, mixture.terms, options.saturated);
    return mixture;
}

struct Blend {
    float share = 0;  ///< As TexelRule::blend.
    double leaveOneOutError = 0;
};

/// Chroma by kriging and chroma of channels that are estimated like luminance: the blend by which
/// the samples predict one another best. kriged: predicted chroma of each texel.
Blend chooseBlend(const PriorModel& model, const std::vector<PriorTerm>& terms,
                  const std::vector<Eigen::MatrixX3d>& texels,
                  const std::vector<Eigen::MatrixX3d>& kriged, double shown) {
    const auto count = static_cast<double>(texels.size());
    std::vector<Eigen::MatrixX3d> ofChannels(texels.size());
    std::vector<Eigen::ArrayXd> predicted(texels.size());
    forEachImage(texels.size(), [&](std::size_t t) {
        ofChannels[t].resize(texels[t].rows(), 3);
        for (Eigen::Index c = 0; c < 3; ++c) {
            ofChannels[t].col(c) =
                leaveOneOut(model, terms, channelSamples(texels[t], c)).cwiseMax(1e-9 / shown);
        }
        ofChannels[t] = normalizedChroma(ofChannels[t]);
        predicted[t] = leaveOneOut(model, terms, texels[t].rowwise().sum() / 3);
    });
    const auto deltaE = [&](std::size_t t, float blend, const Eigen::ArrayXd& luminance) {
        const auto share = static_cast<double>(blend);
        const Eigen::MatrixX3d chroma = (1 - share) * kriged[t] + share * ofChannels[t];
        return meanDeltaE(chroma.array().colwise() * luminance, texels[t], shown);
    };
    Blend chosen;
    double best = -1;
    for (const float share : kBlends) {
        double error = 0;
        for (std::size_t t = 0; t < texels.size(); ++t) {
            error += deltaE(t, share, texels[t].rowwise().sum() / 3);
        }
        error /= count;
        if (best >= 0 && error >= best - 1e-9) continue;
        best = error;
        chosen.share = share;
    }
    for (std::size_t t = 0; t < texels.size(); ++t) {
        chosen.leaveOneOutError += deltaE(t, chosen.share, predicted[t]) / count;
    }
    return chosen;
}

}  // namespace

PriorFit fitPrior(const PriorModel& model, std::span<const Rgb> mean, std::span<const Rgb> texels,
                  const ReconstructOptions& options) {
    Eigen::MatrixX3d colors = matrixOf(mean);
    std::vector<Eigen::MatrixX3d> chosenBy =
        texels.empty() ? std::vector{colors} : matricesOf(texels, mean.size());
    Mixture mixture = chooseMixture(model, options, colors, chosenBy);
    const double shown = choiceExposure(luminancesOf(chosenBy).reshaped());
    ChromaKriging kriging(model.samples, colors, chosenBy, shown);
    const Blend blend = chooseBlend(model, mixture.terms, chosenBy, kriging.leaveOneOut(), shown);
    const TexelRule rule{.cap = static_cast<float>(mostLog(model)),
                         .floor = static_cast<float>(kPriorFloor),
                         .blend = blend.share};
    return {std::move(mixture.terms),
            std::move(mixture.censored),
            std::move(colors),
            std::move(kriging),
            rule,
            shown,
            blend.leaveOneOutError};
}

}  // namespace abrdf
