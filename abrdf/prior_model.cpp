// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/prior_model.h"

#include "abrdf/discrepancy_kernel.h"
#include "abrdf/for_each_texel.h"
#include "abrdf/pair_features.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace abrdf {

namespace {

/// Of the discrepancy between real materials and random ones, in ln(luminance), and its reach.
constexpr std::array kDeviations = {0.1, 0.3, 0.8};
constexpr std::array kLengths = {0.6, 1.2};

}  // namespace

double largestMean(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto count = static_cast<std::size_t>(
        std::max(1L, std::lround(0.04 * static_cast<double>(values.size()))));
    std::ranges::partial_sort(values, values.begin() + static_cast<std::ptrdiff_t>(count),
                              std::ranges::greater());
    return std::accumulate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count),
                           0.0) /
           static_cast<double>(count);
}

std::vector<PriorSpectrum> spectraOf(const Eigen::MatrixXd& covariance, MaterialClass materialClass,
                                     const std::vector<LightAndView>& samples) {
    std::vector<PriorSpectrum> spectra(1);
    std::vector<Eigen::MatrixXd> covariances = {covariance};
    for (const double length : kLengths) {
        const Eigen::MatrixXd kernel = discrepancyKernel(materialClass, samples, samples, length);
        for (const double sigma : kDeviations) {
            spectra.push_back({sigma, length, {}, {}});
            covariances.emplace_back(covariance + sigma * sigma * kernel);
        }
    }
    forEachImage(spectra.size(), [&](std::size_t i) {
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariances[i]);
        if (solver.info() != Eigen::Success) {
            throw std::runtime_error(
                "the covariance of the plan's samples has no spectrum; choose another plan");
        }
        // A covariance has no negative eigenvalues but by rounding.
        spectra[i].eigenvalues = solver.eigenvalues().cwiseMax(0);
        spectra[i].eigenvectors = solver.eigenvectors();
    });
    return spectra;
}

PriorModel withSamples(const PriorModel& model, const std::vector<std::size_t>& kept) {
    PriorModel result;
    result.outputs = model.outputs;
    result.scaleFactor = model.scaleFactor;
    result.errorScale = model.errorScale;
    for (const std::size_t k : kept) result.samples.push_back(model.samples[k]);
    for (const PriorClass& from : model.classes) {
        const PriorSpectrum& plain = from.spectra.front();
        const Eigen::MatrixXd covariance =
            plain.eigenvectors * plain.eigenvalues.asDiagonal() * plain.eigenvectors.transpose();
        PriorClass to;
        to.materialClass = from.materialClass;
        to.sampleMean = from.sampleMean(kept);
        to.outputMean = from.outputMean;
        to.cross = from.cross(Eigen::all, kept);
        to.spectra = spectraOf(covariance(kept, kept), from.materialClass, result.samples);
        result.classes.push_back(std::move(to));
    }
    return result;
}

PriorModel withOutputs(const PriorModel& model, const std::vector<std::size_t>& kept) {
    PriorModel result;
    result.samples = model.samples;
    result.scaleFactor = model.scaleFactor;
    result.errorScale = model.errorScale;
    result.classes = model.classes;
    for (const std::size_t k : kept) result.outputs.push_back(model.outputs[k]);
    const std::vector<std::size_t> rowOf = isotropicPairs(model.outputs).rowOf;
    const std::vector<std::size_t> keptRowOf = isotropicPairs(result.outputs).rowOf;
    std::vector<std::size_t> isotropic;  // The first pair of each group names its row.
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (keptRowOf[i] == isotropic.size()) isotropic.push_back(rowOf[kept[i]]);
    }
    for (std::size_t c = 0; c < model.classes.size(); ++c) {
        const PriorClass& from = model.classes[c];
        const auto& rows = from.materialClass == MaterialClass::kIso ? isotropic : kept;
        result.classes[c].outputMean = from.outputMean(rows);
        result.classes[c].cross = from.cross(rows, Eigen::all);
    }
    return result;
}

}  // namespace abrdf
