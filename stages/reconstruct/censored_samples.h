// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/reconstruct/prior_choice.h"

#include <Eigen/Core>

#include <vector>

namespace abrdf {

/// Puts back what an overexposed photograph cut off. A clipped sample says only "at least": its
/// luminance becomes what the others predict, where that is more.
class CensoredSamples {
  public:
    /// saturated: a sample with a channel at or above it is clipped; > 0.
    CensoredSamples(const PriorModel& model, const std::vector<PriorTerm>& terms, double saturated);

    /// The same samples, a row each; those without any clipped one come back as they are, and so
    /// do those without an unclipped one.
    Eigen::MatrixX3d restored(const Eigen::MatrixX3d& colors) const;

  private:
    std::vector<Eigen::Index> clippedRows(const Eigen::MatrixX3d& colors) const;
    Eigen::VectorXd restoredLogs(const Eigen::VectorXd& z, std::vector<Eigen::Index> unknown) const;

    double saturated_;
    double scaleFactor_;
    Eigen::VectorXd mean_;       ///< Of ln(value / scale + floor) under the mixture.
    Eigen::MatrixXd precision_;  ///< Of the same.
};

}  // namespace abrdf
