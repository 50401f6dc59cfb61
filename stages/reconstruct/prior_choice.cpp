// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_choice.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace abrdf {

namespace {

constexpr std::array kNus = {3e-4, 3e-3, 3e-2};

/// Members of the mixture, counted with repetition; more gains nothing.
constexpr std::size_t kMembers = 12;

/// Samples in no more subspaces (theta_i, theta_v) than this lie on slices.
constexpr std::size_t kSliceSubspaces = 16;
constexpr double kLikelihoodShare = 0.25;
constexpr double kLikelihoodTemperature = 0.1;
constexpr double kLeastWeight = 0.01;
constexpr double kNever = 1e30;  ///< Minus this likelihood has no share.

Eigen::VectorXd valuesFromLogs(const Eigen::VectorXd& logs, double scale) {
    return (logs.array().exp() - kPriorFloor).max(0.0) * scale;
}

/// The texels that a choice is made by, a column each; black ones are left out.
struct ChoiceTexels {
    Eigen::MatrixXd z;          ///< As LogSamples.
    Eigen::VectorXd shown;      ///< Scale of each times the exposure.
    Eigen::MatrixXd lightness;  ///< L* of each sample.
};

ChoiceTexels choiceTexels(const PriorModel& model, const Eigen::MatrixXd& luminance) {
    const double exposure = choiceExposure(luminance.reshaped());
    ChoiceTexels texels;
    texels.z.resize(luminance.rows(), luminance.cols());
    texels.shown.resize(luminance.cols());
    texels.lightness.resize(luminance.rows(), luminance.cols());
    Eigen::Index count = 0;
    for (const auto& column : luminance.colwise()) {
        const LogSamples logs = logSamples(model, column);
        if (!(logs.scale > 0)) continue;
        texels.z.col(count) = logs.z;
        texels.shown(count) = logs.scale * exposure;
        texels.lightness.col(count) = (column * exposure).unaryExpr(&lightness);
        ++count;
    }
    texels.z.conservativeResize(Eigen::NoChange, count);
    texels.lightness.conservativeResize(Eigen::NoChange, count);
    return texels;
}

/// Mean difference in L* of samples whose logarithms are off by `residual`.
double meanLightnessDifference(const ChoiceTexels& texels, const Eigen::MatrixXd& residual) {
    double sum = 0;
    for (Eigen::Index t = 0; t < residual.cols(); ++t) {
        for (Eigen::Index i = 0; i < residual.rows(); ++i) {
            const double value =
                std::max(std::exp(texels.z(i, t) - residual(i, t)) - kPriorFloor, 0.0);
            sum += std::abs(lightness(value * texels.shown(t)) - texels.lightness(i, t));
        }
    }
    return sum / static_cast<double>(residual.size());
}

/// How a term sees the samples of some texels.
struct Fit {
    /// How far each sample is from its prediction by the others, in logarithms: a_i / A_ii with
    /// a = A (z - mean). A column a texel.
    Eigen::MatrixXd residual;
    double logLikelihood = 0;  ///< Mean over the texels, but for a constant.
};

/// The one number of a Lambertian, without a sample, is the mean of the others.
Fit lambertFit(const PriorModel& model, const Eigen::MatrixXd& z) {
    const Eigen::MatrixXd level = z.colwise() - lambertLogs(model.samples);
    const auto n = static_cast<double>(level.rows());
    const Eigen::RowVectorXd mean = level.colwise().mean();
    return {(level.rowwise() - mean) * (n / std::max(n - 1, 1.0)), -kNever};
}

Fit fitOf(const PriorModel& model, const PriorTerm& term, const Eigen::MatrixXd& z) {
    if (term.isLambert) return lambertFit(model, z);
    const PriorClass& priorClass = model.classes[term.classIndex];
    const PriorSpectrum& spectrum = priorClass.spectra[term.spectrum];
    const Eigen::ArrayXd inverse = 1 / (spectrum.eigenvalues.array() + term.nu);
    const Eigen::MatrixXd along =
        spectrum.eigenvectors.transpose() * (z.colwise() - priorClass.sampleMean);
    const Eigen::MatrixXd weighted = inverse.matrix().asDiagonal() * along;
    const Eigen::VectorXd diagonal =
        spectrum.eigenvectors.array().square().matrix() * inverse.matrix();
    return {diagonal.cwiseInverse().asDiagonal() * (spectrum.eigenvectors * weighted),
            0.5 * (inverse.log().sum() -
                   along.cwiseProduct(weighted).sum() / static_cast<double>(z.cols()))};
}

/// Shares of the fits in the mixture that grows by the member with which the residuals, averaged,
/// are least in lightness.
std::vector<double> grownShares(const std::vector<Fit>& fits, const ChoiceTexels& texels) {
    std::vector<double> shares(fits.size());
    std::vector<double> errors(fits.size());
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(texels.z.rows(), texels.z.cols());
    for (std::size_t member = 1; member <= kMembers; ++member) {
        forEachTexelBlock(fits.size(), 3, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                errors[i] = meanLightnessDifference(
                    texels, (sum + fits[i].residual) / static_cast<double>(member));
            }
        });
        const auto best =
            static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin());
        shares[best] += 1.0 / static_cast<double>(kMembers);
        sum += fits[best].residual;
    }
    return shares;
}

void addLikelihood(const std::vector<Fit>& fits, std::vector<double>& shares) {
    const double most = std::ranges::max_element(fits, {}, &Fit::logLikelihood)->logLikelihood;
    const auto likelihood = [&](const Fit& fit) {
        return std::exp(kLikelihoodTemperature * (fit.logLikelihood - most));
    };
    double sum = 0;
    for (const Fit& fit : fits) sum += likelihood(fit);
    for (std::size_t i = 0; i < fits.size(); ++i) {
        shares[i] =
            (1 - kLikelihoodShare) * shares[i] + kLikelihoodShare * likelihood(fits[i]) / sum;
    }
}

/// Terms with their shares; small ones are dropped, the larger come first.
std::vector<PriorTerm> weighted(std::vector<PriorTerm> terms, const std::vector<double>& shares) {
    double sum = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        terms[i].weight = shares[i];
        sum += shares[i] < kLeastWeight ? 0 : shares[i];
    }
    std::erase_if(terms, [](const PriorTerm& term) { return term.weight < kLeastWeight; });
    for (PriorTerm& term : terms) term.weight /= sum;
    std::ranges::stable_sort(terms, std::ranges::greater(), &PriorTerm::weight);
    return terms;
}

}  // namespace

double isotropicShare(const PriorModel& model, const std::vector<PriorTerm>& terms) {
    double share = 0;
    for (const PriorTerm& term : terms) {
        const bool isIso =
            term.isLambert || model.classes[term.classIndex].materialClass == MaterialClass::kIso;
        share += isIso ? term.weight : 0;
    }
    return share;
}

double mostLog(const PriorModel& model) {
    return std::log(3 / model.scaleFactor) + 0.7;
}

std::pair<long, long> subspaceOf(const LightAndView& sample) {
    return {std::lround(10 * degreesFromRadians(sample.light.theta)),
            std::lround(10 * degreesFromRadians(sample.view.theta))};
}

bool lieOnSlices(const std::vector<LightAndView>& samples) {
    std::set<std::pair<long, long>> subspaces;
    for (const LightAndView& s : samples) subspaces.insert(subspaceOf(s));
    return subspaces.size() <= kSliceSubspaces;
}

Eigen::VectorXd lambertLogs(const std::vector<LightAndView>& pairs) {
    Eigen::VectorXd logs(static_cast<Eigen::Index>(pairs.size()));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        logs(static_cast<Eigen::Index>(i)) =
            std::log(std::max(std::cos(pairs[i].light.theta), kPriorFloor));
    }
    return logs;
}

double choiceExposure(const Eigen::VectorXd& luminance) {
    constexpr double kShown = 0.2;
    std::vector<double> sorted(luminance.data(), luminance.data() + luminance.size());
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle);
    if (*middle > 0) return kShown / *middle;
    const double mean = luminance.mean();
    return mean > 0 ? kShown / mean : 1;
}

LogSamples logSamples(const PriorModel& model, const Eigen::VectorXd& values) {
    LogSamples result;
    result.scale = model.scaleFactor *
                   largestMean(std::vector<double>(values.data(), values.data() + values.size()));
    if (result.scale > 0) {
        result.z = (values.array().max(0.0) / result.scale + kPriorFloor).log();
    }
    return result;
}

Eigen::MatrixXd precisionOf(const PriorModel& model, const PriorTerm& term) {
    const PriorSpectrum& spectrum = model.classes[term.classIndex].spectra[term.spectrum];
    const Eigen::VectorXd inverse = (spectrum.eigenvalues.array() + term.nu).inverse();
    return spectrum.eigenvectors * inverse.asDiagonal() * spectrum.eigenvectors.transpose();
}

std::vector<PriorTerm> chooseTerms(const PriorModel& model, const Eigen::MatrixXd& luminance,
                                   double noise) {
    std::vector<PriorTerm> terms;
    for (std::size_t c = 0; c < model.classes.size(); ++c) {
        for (std::size_t k = 0; k < model.classes[c].spectra.size(); ++k) {
            for (const double nu : kNus) {
                terms.push_back({false, c, k, nu + noise * noise, 0});
            }
        }
    }
    terms.push_back({true, 0, 0, 0, 0});
    const ChoiceTexels texels = choiceTexels(model, luminance);
    if (texels.z.cols() == 0) return weighted({terms.back()}, {1});
    std::vector<Fit> fits(terms.size());
    forEachTexelBlock(terms.size(), kNus.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) fits[i] = fitOf(model, terms[i], texels.z);
    });
    std::vector<double> shares = grownShares(fits, texels);
    // A material that obeys Lambert at every sample is one: its law is the last term.
    const bool isLambertian = shares.back() > 1 - 1e-9;
    if (lieOnSlices(model.samples) && !isLambertian) addLikelihood(fits, shares);
    return weighted(std::move(terms), shares);
}

Eigen::VectorXd leaveOneOut(const PriorModel& model, const std::vector<PriorTerm>& terms,
                            const Eigen::VectorXd& values) {
    const LogSamples logs = logSamples(model, values);
    if (logs.scale <= 0) return values;
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(values.size());
    for (const PriorTerm& term : terms) {
        residual += term.weight * fitOf(model, term, logs.z).residual;
    }
    return valuesFromLogs(logs.z - residual, logs.scale);
}

}  // namespace abrdf
