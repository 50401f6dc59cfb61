// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "stages/reconstruct/prior_choice.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace abrdf {

/// Samples that are left out together, by their indices.
using SampleBlocks = std::vector<std::vector<Eigen::Index>>;

/// One by one where samples lie scattered; all of a subspace (theta_i, theta_v) at once where they
/// lie on slices: neighbours on a slice predict one another far better than anything else.
SampleBlocks leaveOutBlocks(const std::vector<LightAndView>& samples);

/// How many of the outputs each sample is the nearest of, as shares that sum to 1: samples that
/// were chosen where values are hard to tell speak for few others. weights: of the outputs, their
/// sum is 1; empty: all alike.
std::vector<float> outputShares(const std::vector<LightAndView>& samples,
                                const std::vector<LightAndView>& outputs,
                                std::span<const double> weights = {});

/// How much nearer to a sample outputs are than samples outside a block are to those in it, over
/// all outputs: errors fall about as distances do. In the space of isotropic features, or with the
/// directions' vectors beside them.
double nearness(const std::vector<LightAndView>& samples, const SampleBlocks& blocks,
                const std::vector<LightAndView>& outputs, bool isIsotropic);

/// The matrix that gives, of centred samples, how far each is from what the samples outside its
/// block predict: the rows of block B are (A_BB)^-1 A_B, A the samples' precision.
Eigen::MatrixXd leaveOutMatrix(const Eigen::MatrixXd& precision, const SampleBlocks& blocks);

/// The same of a mixture, of logarithms as they are: residual = matrix z - offset.
struct LeaveOutMap {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd offset;
};
LeaveOutMap leaveOutMap(const PriorModel& model, const std::vector<PriorTerm>& terms,
                        const SampleBlocks& blocks);

}  // namespace abrdf
