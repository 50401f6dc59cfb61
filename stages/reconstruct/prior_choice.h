// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

namespace abrdf {

/// One model of the mixture, and its share: (S + sigma^2 K + nu I)^-1 of a class, or Lambert's law.
struct PriorTerm {
    bool isLambert = false;  ///< ln(value) = ln(cos(theta_i)) + what the samples have in common.
    std::size_t classIndex = 0;
    std::size_t spectrum = 0;
    double nu = 0;  ///< Variance of a sample that no model explains, in ln(luminance).
    double weight = 0;
};

/// The share of class iso and Lambert's law in a mixture, 0 .. 1.
double isotropicShare(const PriorModel& model, const std::vector<PriorTerm>& terms);

/// Samples of one channel as the model sees them.
struct LogSamples {
    double scale = 0;   ///< Of the material; 0 where all samples are black.
    Eigen::VectorXd z;  ///< ln(value / scale + floor).
};
LogSamples logSamples(const PriorModel& model, const Eigen::VectorXd& values);

/// ln of the largest value, relative to the scale, that is believed: three times the largest
/// samples, and a little room for a highlight between them.
double mostLog(const PriorModel& model);

/// (theta_i, theta_v) in tenths of a degree.
std::pair<long, long> subspaceOf(const LightAndView& sample);

/// True where the samples share so few subspaces (theta_i, theta_v) that they lie on slices.
bool lieOnSlices(const std::vector<LightAndView>& samples);

/// ln(cos(theta_i)) of each pair: what a Lambertian varies with.
Eigen::VectorXd lambertLogs(const std::vector<LightAndView>& pairs);

/// The exposure at which a material's models are compared: its median luminance is shown as 0.2,
/// so that a choice does not depend on the unit of the samples. 1 for a black one.
double choiceExposure(const Eigen::VectorXd& luminance);

/// The mixture for a material, from the luminance of its samples, a column a texel (or its mean),
/// the larger weights first: members are added one by one, each time the one with which the samples
/// predict one another best. Where the samples lie on slices, and so predict one another too well,
/// a quarter goes by likelihood. noise: relative deviation of the samples' noise; its square adds
/// to nu.
std::vector<PriorTerm> chooseTerms(const PriorModel& model, const Eigen::MatrixXd& luminance,
                                   double noise);

/// What the mixture predicts for each sample of a channel from the others: closed form.
Eigen::VectorXd leaveOneOut(const PriorModel& model, const std::vector<PriorTerm>& terms,
                            const Eigen::VectorXd& values);

/// (S + sigma^2 K + nu I)^-1 of a term that is not Lambert's.
Eigen::MatrixXd precisionOf(const PriorModel& model, const PriorTerm& term);

}  // namespace abrdf
