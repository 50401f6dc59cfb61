// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "abrdf/progress.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

struct TrainOptions {
    /// Random materials of each class, >= 2. 0: 2,000, fewer where there are more than 6,561
    /// outputs, down to 500, which costs .06 Delta E at 52 samples and nothing at 204.
    std::size_t materials = 0;
    std::uint64_t seed = 1;  ///< Of the materials.
};

/// The options with their materials settled for so many outputs.
TrainOptions settled(TrainOptions options, std::size_t outputs);

/// Learns the model of `prior` from random materials: their covariances between `samples` (at
/// least one) and distinct `outputs`. The same bits for any number of threads.
/// Ticks: phase "train", unit "materials". Throws std::invalid_argument, Cancelled.
PriorModel trainPrior(const std::vector<LightAndView>& samples,
                      const std::vector<LightAndView>& outputs, const TrainOptions& options,
                      const ProgressSink& progress);

}  // namespace abrdf
