// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"

#include <span>

namespace abrdf {

/// Learns how true errors compare with what left-out samples show, on random materials that the
/// model was not trained with: for each kind of material the factor that 95 % keep to.
/// exposure: at which errors are meant; weights: how much each of the model's outputs matters,
/// their sum is 1; empty: all alike. The same for any number of threads.
ErrorScale learnErrorScale(const PriorModel& model, double exposure,
                           std::span<const double> weights = {});

}  // namespace abrdf
