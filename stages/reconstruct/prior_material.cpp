// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_material.h"

#include "stages/reconstruct/leave_out.h"
#include "stages/reconstruct/low_rank.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace abrdf {

namespace {

constexpr std::array kLadder = {int{kConstantRank}, int{kIsotropicRank}, 4, 8, 16, 32, 64};

/// How a material's texels are expected to vary about its mean, in logarithms: as random materials
/// of its classes do.
Eigen::MatrixXd covarianceOf(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    constexpr double kNoise = 1e-2;
    const auto n = static_cast<Eigen::Index>(model.samples.size());
    Eigen::MatrixXd sum = kNoise * Eigen::MatrixXd::Identity(n, n);
    for (const PriorTerm& term : terms) {
        if (term.isLambert) continue;
        const PriorSpectrum& plain = model.classes[term.classIndex].spectra.front();
        sum += term.weight * plain.eigenvectors * plain.eigenvalues.asDiagonal() *
               plain.eigenvectors.transpose();
    }
    return sum;
}

double errorScaleOf(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    return isotropicShare(model, terms) >= kIsotropicShare ? model.errorScale.isotropic
                                                           : model.errorScale.other;
}

/// How much the rows of the maps matter; none where all pairs are alike.
Eigen::VectorXd rowWeights(const WholeMaps& whole, std::span<const double> weights) {
    Eigen::VectorXd ofRows;
    if (!weights.empty()) ofRows.setZero(whole.luminance.rows());
    for (std::size_t pair = 0; pair < weights.size(); ++pair) {
        ofRows(static_cast<Eigen::Index>(whole.rowOf[pair])) += weights[pair];
    }
    return ofRows;
}

/// All but the models.
LadderParts ladderParts(const PriorModel& model, const PriorFit& fit, const WholeMaps& whole,
                        const ReconstructOptions& options, int mostRank) {
    LadderParts parts;
    parts.exposure = static_cast<float>(options.exposure);
    parts.errorScale = static_cast<float>(errorScaleOf(model, fit.terms));
    parts.tolerance = static_cast<float>(options.tolerance);
    for (const LightAndView& sample : model.samples) {
        parts.sampleCosines.push_back(std::cos(sample.light.theta));
    }
    parts.sampleShares = outputShares(model.samples, whole.pairs, options.weights);
    for (const int rank : kLadder) {
        if (options.tolerance > 0 && rank < mostRank) {
            parts.ranks.push_back(static_cast<std::uint16_t>(rank));
        }
    }
    parts.ranks.push_back(static_cast<std::uint16_t>(mostRank));
    return parts;
}

}  // namespace

PriorMaterial::PriorMaterial(const PriorModel& model, std::span<const std::size_t> rowOf,
                             std::span<const Rgb> mean, const ReconstructOptions& options,
                             std::span<const Rgb> texels)
    : isAlone_(options.alone && options.centered && options.rank == 0 && options.tolerance <= 0) {
    const PriorFit fit = fitPrior(model, mean, texels, options);
    terms_ = fit.terms;
    leaveOneOutError_ = fit.leaveOneOutError;
    shownExposure_ = fit.shownExposure;
    // The centre of a texel that is alone is the texel: as it will be encoded.
    PriorEncoder::Centers centers = PriorEncoder::centersOf(
        isAlone_ && fit.censored ? fit.censored->restored(matrixOf(mean)) : fit.mean,
        model.scaleFactor);
    if (!options.centered) {
        for (Eigen::VectorXf& center : centers.logs) center.setZero();
        for (Eigen::VectorXf& center : centers.chroma) center.setZero();
    }
    encoder_ = PriorEncoder(model.scaleFactor, std::move(centers), fit.rule, fit.censored);
    buildModel(model, fit, wholeMaps(model, fit, encoder_.centers(), rowOf, isAlone_), options);
}

void PriorMaterial::buildModel(const PriorModel& model, const PriorFit& fit, const WholeMaps& whole,
                               const ReconstructOptions& options) {
    const auto samples = static_cast<int>(model.samples.size());
    const int most = options.rank > 0 ? std::min(options.rank, samples) : samples;
    const bool hasSteps = options.tolerance > 0;
    LadderParts parts = ladderParts(model, fit, whole, options, most);
    parts.leaveOut = leaveOutModel(model, fit, encoder_.centers());
    model_ = TexelModel(whole.basisOf(whole.luminance, whole.chroma), fit.rule, whole.rowOf,
                        whole.pairs);
    if (most < samples || hasSteps) {
        const std::vector<std::size_t> probes = probesOf(whole.pairs.size(), options.weights);
        const Eigen::VectorXd weights = rowWeights(whole, options.weights);
        parts.wholeProbes = model_.restricted(probes);
        const int columns = most < samples ? most : std::min(kLadder.back(), samples);
        const NestedBasis luminance =
            nestedBasis(whole.luminance, covarianceOf(model, fit.terms), columns, weights);
        const NestedBasis chroma =
            nestedBasis(whole.chroma, fit.kriging.covariance(), columns, weights);
        TexelBasis small = whole.basisOf(luminance.basis, chroma.basis);
        if (most < samples) {
            model_ = TexelModel(std::move(small), fit.rule, whole.rowOf, whole.pairs);
        } else {
            model_.addSmall(std::move(small));
        }
        if (hasSteps && columns > kIsotropicRank) model_.addIsotropic(whole.pairs);
        projection_ =
            CodeProjection(luminance.projection, chroma.projection, fit.rule, model_.columns());
        parts.probes = model_.restricted(probes);
    }
    ladder_ = PriorLadder(std::move(parts));
}

TexelCodes PriorMaterial::encode(std::span<const Rgb> samples, std::span<float> deltaE) const {
    std::vector<Rgb> restored;
    TexelCodes whole = encoder_.encode(samples, restored);
    if (projection_.isNone()) {
        if (!deltaE.empty()) {
            std::ranges::copy(ladder_.leftOutErrors(whole, restored), deltaE.begin());
        }
        return isAlone_ ? codesOfCenter(whole, model_.rule()) : whole;
    }
    const bool hasSteps = ladder_.ranks().size() > 1;
    std::vector<float> errors(whole.count());
    TexelCodes codes = projection_.projected(whole);
    if (!deltaE.empty() || hasSteps) {
        ladder_.choose(whole, codes, restored, deltaE.empty() ? std::span(errors) : deltaE);
    }
    if (hasSteps) cutToRanks(whole, codes);
    return codes;
}

void PriorMaterial::reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const {
    model_.evaluate(encode(samples), abrdfs);
}

double PriorMaterial::multiplyAdds() const {
    return projection_.multiplyAdds() + model_.multiplyAdds(model_.columns());
}

double PriorMaterial::multiplyAddsOfRank(std::uint16_t rank) const {
    const auto step = static_cast<std::size_t>(std::ranges::find(ladder_.ranks(), rank) -
                                               ladder_.ranks().begin());
    return projection_.multiplyAdds() + ladder_.multiplyAdds(step) + model_.multiplyAdds(rank);
}

}  // namespace abrdf
