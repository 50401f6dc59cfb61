// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "stages/train/train_prior.h"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace abrdf {

/// What a model depends on, as a number: samples, outputs, options, and the version of training.
std::uint64_t modelKey(const std::vector<LightAndView>& samples,
                       const std::vector<LightAndView>& outputs, const TrainOptions& options);

/// Writes a model, whole or not at all. Little-endian: a magic, a hash of what follows, the
/// directions, and class by class its means, covariances and spectra.
void writeModel(const std::filesystem::path& path, const PriorModel& model);

/// Throws std::runtime_error that names the file where it is not a whole model.
PriorModel readModel(const std::filesystem::path& path);

}  // namespace abrdf
