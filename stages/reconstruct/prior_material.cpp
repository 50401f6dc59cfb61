// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_material.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"
#include "color/delta_e.h"
#include "stages/reconstruct/leave_out.h"
#include "stages/reconstruct/low_rank.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace abrdf {

namespace {

constexpr std::array kBlends = {0.0F, 0.25F, 0.5F, 0.75F, 1.0F};
constexpr std::array kLadder = {int{kConstantRank}, int{kIsotropicRank}, 4, 8, 16, 32, 64};

/// A column a texel.
Eigen::MatrixXd luminancesOf(const std::vector<Eigen::MatrixX3d>& texels) {
    Eigen::MatrixXd luminances(texels.front().rows(), static_cast<Eigen::Index>(texels.size()));
    for (std::size_t t = 0; t < texels.size(); ++t) {
        luminances.col(static_cast<Eigen::Index>(t)) = texels[t].rowwise().sum() / 3;
    }
    return luminances;
}

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

/// The mean luminance of the material at the outputs, from its logarithms there.
Eigen::VectorXd luminanceFromLogs(const std::vector<float>& x, float cap, double scale) {
    Eigen::VectorXd luminance(static_cast<Eigen::Index>(x.size()));
    for (std::size_t i = 0; i < x.size(); ++i) {
        luminance(static_cast<Eigen::Index>(i)) =
            scale * std::max(std::exp(static_cast<double>(std::min(x[i], cap))) - kPriorFloor, 0.0);
    }
    return luminance;
}

std::vector<float> numbersOf(const Eigen::VectorXf& values) {
    return {values.data(), values.data() + values.size()};
}

template <typename Vectors>
Eigen::MatrixXd columnsOf(const Vectors& vectors) {
    Eigen::MatrixXd columns(vectors[0].size(), static_cast<Eigen::Index>(vectors.size()));
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        columns.col(static_cast<Eigen::Index>(i)) = vectors[i].template cast<double>();
    }
    return columns;
}

}  // namespace

PriorMaterial::PriorMaterial(const PriorModel& model, std::span<const std::size_t> rowOf,
                             std::span<const Rgb> mean, const ReconstructOptions& options,
                             std::span<const Rgb> texels) {
    isAlone_ = options.alone && options.centered && options.rank == 0 && options.tolerance <= 0;
    Eigen::MatrixX3d colors = matrixOf(mean);
    const std::vector<Eigen::MatrixX3d> chosenBy = chooseModels(model, colors, texels, options);
    shownExposure_ = choiceExposure(luminancesOf(chosenBy).reshaped());
    const ChromaKriging kriging(model.samples, colors, chosenBy, shownExposure_);
    rule_.floor = static_cast<float>(kPriorFloor);
    rule_.cap = static_cast<float>(mostLog(model));
    rule_.blend = chosenBlend(model, chosenBy, shownExposure_, kriging.leaveOneOut());
    // The centre of a texel that is alone is the texel: as it will be encoded.
    PriorEncoder::Centers centers = PriorEncoder::centersOf(
        isAlone_ && censored_ ? censored_->restored(matrixOf(mean)) : colors, model.scaleFactor);
    if (!options.centered) {
        for (Eigen::VectorXf& center : centers.logs) center.setZero();
        for (Eigen::VectorXf& center : centers.chroma) center.setZero();
    }
    encoder_ = PriorEncoder(model.scaleFactor, std::move(centers), rule_, censored_);
    buildModel(model, kriging, wholeMaps(model, rowOf, colors, kriging), options);
}

/// Terms, and what restores clipped samples: of `colors` too, and of the texels that are returned.
std::vector<Eigen::MatrixX3d> PriorMaterial::chooseModels(const PriorModel& model,
                                                          Eigen::MatrixX3d& colors,
                                                          std::span<const Rgb> texels,
                                                          const ReconstructOptions& options) {
    std::vector<Eigen::MatrixX3d> chosenBy;
    const auto mean = static_cast<std::size_t>(colors.rows());
    for (std::size_t first = 0; first < texels.size(); first += mean) {
        chosenBy.push_back(matrixOf(texels.subspan(first, mean)));
    }
    if (chosenBy.empty()) chosenBy = {colors};
    terms_ = chooseTerms(model, luminancesOf(chosenBy), options.noise);
    if (options.saturated > 0) {
        const CensoredSamples censored(model, terms_, options.saturated);
        colors = censored.restored(colors);
        for (Eigen::MatrixX3d& texel : chosenBy) texel = censored.restored(texel);
        terms_ = chooseTerms(model, luminancesOf(chosenBy), options.noise);
        censored_.emplace(model, terms_, options.saturated);
    }
    return chosenBy;
}

/// Chroma by kriging and chroma of channels that are estimated like luminance: the blend by which
/// the samples predict one another best, and how well that is (leaveOneOutError_).
float PriorMaterial::chosenBlend(const PriorModel& model,
                                 const std::vector<Eigen::MatrixX3d>& texels, double shown,
                                 const std::vector<Eigen::MatrixX3d>& kriged) {
    std::vector<Eigen::MatrixX3d> ofChannels(texels.size());
    std::vector<Eigen::VectorXd> predicted(texels.size());
    forEachImage(texels.size(), [&](std::size_t t) {
        ofChannels[t].resize(texels[t].rows(), 3);
        for (Eigen::Index c = 0; c < 3; ++c) {
            ofChannels[t].col(c) =
                leaveOneOut(model, terms_, channelSamples(texels[t], c)).cwiseMax(1e-9 / shown);
        }
        ofChannels[t] = normalizedChroma(ofChannels[t]);
        predicted[t] = leaveOneOut(model, terms_, texels[t].rowwise().sum() / 3);
    });
    const auto chroma = [&](std::size_t t, double share) {
        return Eigen::MatrixX3d((1 - share) * kriged[t] + share * ofChannels[t]);
    };
    double best = -1;
    float chosen = 0;
    for (const float blend : kBlends) {
        double error = 0;
        for (std::size_t t = 0; t < texels.size(); ++t) {
            const Eigen::ArrayXd luminance = texels[t].rowwise().sum() / 3;
            error += meanDeltaE(chroma(t, static_cast<double>(blend)).array().colwise() * luminance,
                                texels[t], shown);
        }
        error /= static_cast<double>(texels.size());
        if (best >= 0 && error >= best - 1e-9) continue;
        best = error;
        chosen = blend;
    }
    leaveOneOutError_ = 0;
    for (std::size_t t = 0; t < texels.size(); ++t) {
        leaveOneOutError_ += meanDeltaE(chroma(t, static_cast<double>(chosen)).array().colwise() *
                                            predicted[t].array(),
                                        texels[t], shown) /
                             static_cast<double>(texels.size());
    }
    return chosen;
}

PriorMaterial::Whole PriorMaterial::wholeMaps(const PriorModel& model,
                                              std::span<const std::size_t> rowOf,
                                              const Eigen::MatrixX3d& colors,
                                              const ChromaKriging& kriging) const {
    Whole whole;
    const PairGroups isotropic = isotropicPairs(model.outputs);
    const bool fewRows = isIsotropic(model, terms_) && !kriging.isAnisotropic();
    const std::vector<LightAndView>& outputs = fewRows ? isotropic.distinct : model.outputs;
    for (const std::size_t row : rowOf) {
        whole.rowOf.push_back(fewRows ? isotropic.rowOf[row] : row);
        whole.pairs.push_back(model.outputs[row]);
    }
    const auto rows = static_cast<Eigen::Index>(outputs.size());
    // What is to be known at once: the centres, and the material's own luminance at the outputs,
    // which is a feature of its chroma.
    const PriorEncoder::Centers& centers = encoder_.centers();
    const LogSamples own = logSamples(model, colors.rowwise().sum() / 3);
    Eigen::VectorXf z = Eigen::VectorXf::Zero(colors.rows());
    if (own.scale > 0) z = own.z.cast<float>();
    std::vector<Eigen::VectorXf> logs(
        centers.logs.begin(),
        centers.logs.begin() + static_cast<std::ptrdiff_t>(rule_.logVectors()));
    logs.push_back(z);
    std::vector<std::vector<float>> mappedLogs;
    if (isAlone_) {
        const Eigen::MatrixXd vectors = columnsOf(logs);
        const PriorMap map = priorMap(model, terms_, outputs, isotropic.rowOf, &vectors);
        for (Eigen::Index i = 0; i < vectors.cols(); ++i) {
            mappedLogs.push_back(numbersOf(map.matrix.col(i) + map.offset));
        }
        whole.luminance = Eigen::MatrixXf::Zero(rows, 1);
    } else {
        PriorMap map = priorMap(model, terms_, outputs, isotropic.rowOf);
        for (const Eigen::VectorXf& vector : logs) {
            mappedLogs.push_back(numbersOf(Eigen::VectorXf(map.matrix * vector) + map.offset));
        }
        whole.luminance = std::move(map.matrix);
    }
    const Eigen::VectorXd luminance = luminanceFromLogs(mappedLogs.back(), rule_.cap, own.scale);
    std::move(mappedLogs.begin(), mappedLogs.end() - 1, whole.centers.logCenters.begin());
    if (isAlone_) {
        const Eigen::MatrixXd vectors = columnsOf(centers.chroma);
        const Eigen::MatrixXf chroma = kriging.outputMatrix(outputs, luminance, &vectors);
        for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
            whole.centers.chromaCenters[c] = numbersOf(chroma.col(static_cast<Eigen::Index>(c)));
        }
        whole.chroma = Eigen::MatrixXf::Zero(rows, 1);
    } else {
        whole.chroma = kriging.outputMatrix(outputs, luminance);
        for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
            whole.centers.chromaCenters[c] = numbersOf(whole.chroma * centers.chroma[c]);
        }
    }
    return whole;
}

/// Predictions are maps like all others: x = z - (R z - r), with z = centre + vector.
TexelModel PriorMaterial::leaveOutModel(const PriorModel& model,
                                        const ChromaKriging& kriging) const {
    const SampleBlocks blocks = leaveOutBlocks(model.samples);
    const LeaveOutMap logs = leaveOutMap(model, terms_, blocks);
    const auto n = static_cast<Eigen::Index>(model.samples.size());
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd luminance = identity - logs.matrix;
    const Eigen::MatrixXd chroma = identity - kriging.leaveOut(blocks);
    const auto numbers = [](const Eigen::VectorXd& values) {
        const Eigen::VectorXf floats = values.cast<float>();
        return std::vector<float>(floats.data(), floats.data() + floats.size());
    };
    TexelBasis basis;
    basis.luminance = PackedMatrix(luminance.cast<float>());
    basis.chroma = PackedMatrix(chroma.cast<float>());
    const PriorEncoder::Centers& centers = encoder_.centers();
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) {
        basis.logCenters[i] = numbers(luminance * centers.logs[i].cast<double>() + logs.offset);
    }
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
        basis.chromaCenters[c] = numbers(chroma * centers.chroma[c].cast<double>());
    }
    std::vector<std::size_t> own(model.samples.size());
    std::iota(own.begin(), own.end(), std::size_t{0});
    return {std::move(basis), rule_, std::move(own), model.samples};
}

void PriorMaterial::buildModel(const PriorModel& model, const ChromaKriging& kriging, Whole whole,
                               const ReconstructOptions& options) {
    const auto samples = static_cast<int>(model.samples.size());
    const int most = options.rank > 0 ? std::min(options.rank, samples) : samples;
    const bool hasSteps = options.tolerance > 0;
    LadderParts parts;
    parts.leaveOut = leaveOutModel(model, kriging);
    parts.exposure = static_cast<float>(options.exposure);
    parts.errorScale = static_cast<float>(errorScaleOf(model, terms_));
    parts.tolerance = static_cast<float>(options.tolerance);
    for (const LightAndView& sample : model.samples) {
        parts.sampleCosines.push_back(std::cos(sample.light.theta));
    }
    parts.sampleShares = outputShares(model.samples, whole.pairs, options.weights);
    for (const int rank : kLadder) {
        if (hasSteps && rank < most) parts.ranks.push_back(static_cast<std::uint16_t>(rank));
    }
    parts.ranks.push_back(static_cast<std::uint16_t>(most));

    const auto basisOf = [&](const Eigen::MatrixXf& luminance, const Eigen::MatrixXf& chroma) {
        TexelBasis basis = whole.centers;
        basis.luminance = PackedMatrix(luminance);
        basis.chroma = PackedMatrix(chroma);
        return basis;
    };
    model_ = TexelModel(basisOf(whole.luminance, whole.chroma), rule_, whole.rowOf, whole.pairs);
    if (most < samples || hasSteps) {
        const std::vector<std::size_t> probes = probesOf(whole.pairs.size(), options.weights);
        const Eigen::VectorXd weights = rowWeights(whole, options.weights);
        parts.wholeProbes = model_.restricted(probes);
        const int columns = most < samples ? most : std::min(kLadder.back(), samples);
        const NestedBasis luminance =
            nestedBasis(whole.luminance, covarianceOf(model, terms_), columns, weights);
        const NestedBasis chroma =
            nestedBasis(whole.chroma, kriging.covariance(), columns, weights);
        luminanceProjection_ = PackedMatrix(luminance.projection);
        chromaProjection_ = PackedMatrix(chroma.projection);
        TexelBasis small = basisOf(luminance.basis, chroma.basis);
        if (most < samples) {
            model_ = TexelModel(std::move(small), rule_, whole.rowOf, whole.pairs);
        } else {
            model_.addSmall(std::move(small));
        }
        if (hasSteps && columns > kIsotropicRank) model_.addIsotropic(whole.pairs);
        parts.probes = model_.restricted(probes);
    }
    ladder_ = PriorLadder(std::move(parts));
}

/// How much the rows of the maps matter; none where all pairs are alike.
Eigen::VectorXd PriorMaterial::rowWeights(const Whole& whole, std::span<const double> weights) {
    Eigen::VectorXd ofRows;
    if (!weights.empty()) ofRows.setZero(whole.luminance.rows());
    for (std::size_t pair = 0; pair < weights.size(); ++pair) {
        ofRows(static_cast<Eigen::Index>(whole.rowOf[pair])) += weights[pair];
    }
    return ofRows;
}

TexelCodes PriorMaterial::projected(const TexelCodes& whole) const {
    TexelCodes codes;
    codes.stride = model_.columns();
    codes.scales = whole.scales;
    codes.ranks.assign(whole.count(), static_cast<std::uint16_t>(codes.stride));
    const auto apply = [&](const PackedMatrix& projection, const std::vector<float>& from,
                           std::vector<float>& to) {
        const std::size_t padded = projection.panels() * PackedMatrix::kPanel;
        std::vector<float> products(whole.count() * padded);
        projection.multiply(from, 0, projection.panels(), products.data(), padded);
        to.resize(whole.count() * codes.stride);
        for (std::size_t t = 0; t < whole.count(); ++t) {
            std::copy_n(products.begin() + static_cast<std::ptrdiff_t>(t * padded),
                        projection.rows(),
                        to.begin() + static_cast<std::ptrdiff_t>(t * codes.stride));
        }
    };
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) {
        apply(luminanceProjection_, whole.logs[i], codes.logs[i]);
    }
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) {
        apply(chromaProjection_, whole.chroma[c], codes.chroma[c]);
    }
    return codes;
}

TexelCodes PriorMaterial::encode(std::span<const Rgb> samples, std::span<float> deltaE) const {
    std::vector<Rgb> restored;
    TexelCodes whole = encoder_.encode(samples, restored);
    if (luminanceProjection_.columns() == 0) {
        if (!deltaE.empty()) {
            std::ranges::copy(ladder_.leftOutErrors(whole, restored), deltaE.begin());
        }
        return isAlone_ ? codesOfCenter(whole) : whole;
    }
    const bool hasSteps = ladder_.ranks().size() > 1;
    std::vector<float> errors(whole.count());
    TexelCodes codes = projected(whole);
    if (!deltaE.empty() || hasSteps) {
        ladder_.choose(whole, codes, restored, deltaE.empty() ? std::span(errors) : deltaE);
    }
    if (hasSteps) cutToRanks(whole, codes);
    return codes;
}

/// The centre is all that it is asked for, up to the rounding of its logarithms.
TexelCodes PriorMaterial::codesOfCenter(const TexelCodes& whole) const {
    constexpr float kRounding = 1e-4F;
    TexelCodes codes;
    codes.stride = 1;
    codes.scales = whole.scales;
    codes.ranks.assign(whole.count(), 1);
    for (std::size_t i = 0; i < rule_.logVectors(); ++i) codes.logs[i].resize(whole.count());
    for (std::size_t c = 0; c < rule_.chromaVectors(); ++c) codes.chroma[c].resize(whole.count());
    for (std::size_t i = 0; i < whole.logs[0].size(); ++i) {
        if (whole.scales[i / whole.stride].luminance > 0 &&
            std::abs(whole.logs[0][i]) > kRounding) {
            throw std::logic_error("a material of one texel was asked for another");
        }
    }
    return codes;
}

/// What a rank leaves out is nothing; whole texels keep all numbers of theirs.
void PriorMaterial::cutToRanks(const TexelCodes& whole, TexelCodes& codes) const {
    const auto cut = [&](const std::vector<float>& from, std::vector<float>& to) {
        for (std::size_t t = 0; t < codes.count() && !to.empty(); ++t) {
            const auto begin = to.begin() + static_cast<std::ptrdiff_t>(t * codes.stride);
            const std::size_t rank = codes.ranks[t];
            if (rank == whole.stride) {
                std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(t * rank), rank, begin);
            } else {
                std::fill(begin + static_cast<std::ptrdiff_t>(rank),
                          begin + static_cast<std::ptrdiff_t>(codes.stride), 0.0F);
            }
        }
    };
    for (std::size_t i = 0; i < 4; ++i) cut(whole.logs[i], codes.logs[i]);
    for (std::size_t c = 0; c < 2; ++c) cut(whole.chroma[c], codes.chroma[c]);
}

void PriorMaterial::reconstruct(std::span<const Rgb> samples, std::span<Rgb> abrdfs) const {
    model_.evaluate(encode(samples), abrdfs);
}

double PriorMaterial::projectionCost() const {
    return static_cast<double>(
        rule_.logVectors() * luminanceProjection_.rows() * luminanceProjection_.columns() +
        rule_.chromaVectors() * chromaProjection_.rows() * chromaProjection_.columns());
}

double PriorMaterial::multiplyAdds() const {
    return projectionCost() + model_.multiplyAdds(model_.columns());
}

double PriorMaterial::multiplyAddsOfRank(std::uint16_t rank) const {
    const auto step = static_cast<std::size_t>(std::ranges::find(ladder_.ranks(), rank) -
                                               ladder_.ranks().begin());
    return projectionCost() + ladder_.multiplyAdds(step) + model_.multiplyAdds(rank);
}

}  // namespace abrdf
