// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "abrdf/material_class.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace abrdf {

/// Floor of values relative to a material's scale, below which logarithms see no difference.
inline constexpr double kPriorFloor = 1e-5;

/// S + sigma^2 K of the samples as V diag(lambda) V': with it, (S + sigma^2 K + nu I)^-1 costs
/// nothing more for any nu.
struct PriorSpectrum {
    double sigma = 0;   ///< Deviation of the discrepancy kernel in ln(luminance); 0: none.
    double length = 0;  ///< Of the kernel.
    Eigen::VectorXd eigenvalues;
    Eigen::MatrixXd eigenvectors;
};

/// Moments of ln(luminance / scale + floor) over the random materials of one class.
struct PriorClass {
    MaterialClass materialClass = MaterialClass::kIso;
    Eigen::VectorXd sampleMean;          ///< A value a sample.
    Eigen::VectorXf outputMean;          ///< A value an output row.
    Eigen::MatrixXf cross;               ///< Covariances: output row, sample.
    std::vector<PriorSpectrum> spectra;  ///< One for each discrepancy kernel.
};

/// How many times larger true errors are than what leaving out samples shows, at most in 95 % of
/// random materials: of those whose mixture is isotropic (kIsotropicShare), and of others. At
/// exposure 1.
struct ErrorScale {
    double isotropic = 1;
    double other = 1;
};

/// Of class iso and Lambert's law in the mixture of what counts as isotropic.
inline constexpr double kIsotropicShare = 0.9;

/// What the method `prior` has learned for given samples and outputs (design: estimator.md, 2).
/// Class iso has a row for each distinct isotropic pair of the outputs, the others one a pair.
struct PriorModel {
    std::vector<LightAndView> samples;
    std::vector<LightAndView> outputs;  ///< Distinct ones: distinctPairs().
    /// A material's scale is this times the mean of its largest samples (largestMean()).
    double scaleFactor = 1;
    std::vector<PriorClass> classes;
    ErrorScale errorScale;
};

/// Mean of the largest max(1, round(0.04 n)) of n values, which may be reordered.
double largestMean(std::vector<double> values);

/// The same model for the samples `kept` (ascending indices) alone, as when the others are missing.
PriorModel withSamples(const PriorModel& model, const std::vector<std::size_t>& kept);

/// The same model for the outputs `kept` (indices) alone: to look at a few of them.
PriorModel withOutputs(const PriorModel& model, const std::vector<std::size_t>& kept);

/// All spectra of a class from the covariance of its samples: no kernel, then each deviation with
/// each length.
std::vector<PriorSpectrum> spectraOf(const Eigen::MatrixXd& covariance, MaterialClass materialClass,
                                     const std::vector<LightAndView>& samples);

}  // namespace abrdf
