// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_choice.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

constexpr std::array kNus = {3e-4, 3e-3, 3e-2};

/// Sharpness of the choice: a model this much (relatively) worse than the best has 1/e its weight.
constexpr double kSharpness = 0.06;
constexpr double kLeastWeight = 0.01;

/// Lightness differences below which no model is better than another: the scale of "equal".
constexpr double kEqualLightness = 1e-3;

Eigen::VectorXd valuesFromLogs(const Eigen::VectorXd& logs, double scale) {
    return (logs.array().exp() - kPriorFloor).max(0.0) * scale;
}

double meanLightnessDifference(const Eigen::VectorXd& a, const Eigen::VectorXd& b,
                               double exposure) {
    double sum = 0;
    for (Eigen::Index i = 0; i < a.size(); ++i) {
        sum += std::abs(lightness(a(i) * exposure) - lightness(b(i) * exposure));
    }
    return sum / static_cast<double>(a.size());
}

/// How far each sample is from its prediction by the others under a term, in logarithms:
/// a_i / A_ii with a = A (z - mean).
Eigen::VectorXd residualOf(const PriorModel& model, const PriorTerm& term,
                           const Eigen::VectorXd& z) {
    const PriorClass& priorClass = model.classes[term.classIndex];
    const PriorSpectrum& spectrum = priorClass.spectra[term.spectrum];
    const Eigen::ArrayXd inverse = 1 / (spectrum.eigenvalues.array() + term.nu);
    const Eigen::VectorXd along = spectrum.eigenvectors.transpose() * (z - priorClass.sampleMean);
    const Eigen::VectorXd a = spectrum.eigenvectors * (inverse * along.array()).matrix();
    return a.cwiseQuotient(spectrum.eigenvectors.array().square().matrix() * inverse.matrix());
}

/// Errors become weights; those below kLeastWeight are dropped, the larger ones come first.
std::vector<PriorTerm> weighted(std::vector<PriorTerm> terms, const std::vector<double>& errors) {
    const double least = *std::ranges::min_element(errors);
    double sum = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        terms[i].weight = std::exp(-(errors[i] - least) / (kSharpness * (least + kEqualLightness)));
        sum += terms[i].weight;
    }
    std::erase_if(terms, [&](const PriorTerm& t) { return t.weight < kLeastWeight * sum; });
    sum = 0;
    for (const PriorTerm& term : terms) sum += term.weight;
    for (PriorTerm& term : terms) term.weight /= sum;
    std::ranges::stable_sort(terms, std::ranges::greater(), &PriorTerm::weight);
    return terms;
}

}  // namespace

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

std::vector<PriorTerm> chooseTerms(const PriorModel& model, const Eigen::VectorXd& luminance,
                                   const ChoiceOptions& options) {
    std::vector<PriorTerm> terms;
    for (std::size_t c = 0; c < model.classes.size(); ++c) {
        for (std::size_t k = 0; k < model.classes[c].spectra.size(); ++k) {
            for (const double nu : kNus) {
                terms.push_back({c, k, nu + options.noise * options.noise, 0});
            }
        }
    }
    const LogSamples logs = logSamples(model, luminance);
    if (logs.scale <= 0) return weighted({terms.front()}, {0});
    std::vector<double> errors(terms.size());
    forEachTexelBlock(terms.size(), kNus.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Eigen::VectorXd predicted = logs.z - residualOf(model, terms[i], logs.z);
            errors[i] = meanLightnessDifference(valuesFromLogs(predicted, logs.scale), luminance,
                                                options.exposure);
        }
    });
    return weighted(std::move(terms), errors);
}

LeaveOneOut leaveOneOut(const PriorModel& model, const std::vector<PriorTerm>& terms,
                        const Eigen::VectorXd& values, double exposure) {
    const LogSamples logs = logSamples(model, values);
    if (logs.scale <= 0) return {values, 0};
    Eigen::VectorXd residual = Eigen::VectorXd::Zero(values.size());
    for (const PriorTerm& term : terms) {
        residual += term.weight * residualOf(model, term, logs.z);
    }
    LeaveOneOut result;
    result.values = valuesFromLogs(logs.z - residual, logs.scale);
    result.error = meanLightnessDifference(result.values, values, exposure);
    return result;
}

}  // namespace abrdf
