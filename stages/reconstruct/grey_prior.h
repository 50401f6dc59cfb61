// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/reconstruct/leave_out.h"

#include <Eigen/Core>

#include <map>
#include <utility>
#include <vector>

namespace abrdf {

/// What `prior` makes of a grey material.
struct GreyEstimate {
    Eigen::VectorXd outputs;    ///< A value an output of the model.
    Eigen::VectorXd leftOut;    ///< Each sample, predicted from those outside its block.
    double isotropicShare = 0;  ///< Of class iso and Lambert's law in the mixture.
};

/// `prior` for grey materials at few outputs: no map is built, so that a material costs some
/// milliseconds. For trying plans and models on many materials.
class GreyPrior {
  public:
    explicit GreyPrior(const PriorModel& model);

    /// samples: values in the model's order. From any thread.
    GreyEstimate estimate(const Eigen::VectorXd& samples) const;

    /// outputShares() of the model.
    const std::vector<float>& shares() const { return shares_; }

  private:
    struct Sums;
    void addTerm(const PriorTerm& term, const Eigen::VectorXd& z, Sums& sums) const;

    const PriorModel& model_;
    SampleBlocks blocks_;
    std::vector<float> shares_;
    std::vector<std::size_t> isotropicRow_;
    /// Of outputs and samples: for class iso or not, of a length.
    std::map<std::pair<bool, double>, Eigen::MatrixXd> kernels_;
};

}  // namespace abrdf
