// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace abrdf {

/// One model of the mixture: (S + sigma^2 K + nu I)^-1 of a class, and its share.
struct PriorTerm {
    std::size_t classIndex = 0;
    std::size_t spectrum = 0;
    double nu = 0;  ///< Variance of a sample that no model explains, in ln(luminance).
    double weight = 0;
};

/// Samples of one channel as the model sees them.
struct LogSamples {
    double scale = 0;   ///< Of the material; 0 where all samples are black.
    Eigen::VectorXd z;  ///< ln(value / scale + floor).
};
LogSamples logSamples(const PriorModel& model, const Eigen::VectorXd& values);

/// What each sample is by the others.
struct LeaveOneOut {
    Eigen::VectorXd values;  ///< Predictions, in the samples' unit.
    double error = 0;        ///< Mean lightness difference |dL*| at the exposure.
};

struct ChoiceOptions {
    double exposure = 1;  ///< Factor on the values at which lightness is compared; > 0.
    double noise = 0;     ///< Relative deviation of the samples' noise; its square adds to nu.
};

/// The mixture for a material, from its samples' luminance, the larger weights first: members are
/// added one by one, each time the one with which the samples predict one another best. Where the
/// samples lie on slices, and so predict one another too well, a quarter goes by likelihood.
std::vector<PriorTerm> chooseTerms(const PriorModel& model, const Eigen::VectorXd& luminance,
                                   const ChoiceOptions& options);

/// Leave-one-out predictions of the mixture, for one channel's samples: closed form.
LeaveOneOut leaveOneOut(const PriorModel& model, const std::vector<PriorTerm>& terms,
                        const Eigen::VectorXd& values, double exposure);

/// (S + sigma^2 K + nu I)^-1 of a term.
Eigen::MatrixXd precisionOf(const PriorModel& model, const PriorTerm& term);

}  // namespace abrdf
