// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "abrdf/progress.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

struct TrainOptions {
    std::size_t materials = 2000;  ///< Random materials of each class, >= 2; more gains little.
    std::uint64_t seed = 1;        ///< Of the materials.
};

/// Learns the model of `prior` from random materials: their covariances between `samples` (at
/// least one) and `outputs`. The same bits for any number of threads.
/// Ticks: phase "train", unit "materials". Throws std::invalid_argument, Cancelled.
PriorModel trainPrior(const std::vector<LightAndView>& samples,
                      const std::vector<LightAndView>& outputs, const TrainOptions& options,
                      const ProgressSink& progress);

}  // namespace abrdf
