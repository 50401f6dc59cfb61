// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/prior_model.h"
#include "abrdf/progress.h"
#include "stages/train/train_prior.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace abrdf {

/// Where a job finds the prior's model.
struct PriorSource {
    std::optional<std::filesystem::path> file;  ///< --model: this one, which must fit the job.
    TrainOptions train;
};

/// $XDG_CACHE_HOME/abrdf, else ~/.cache/abrdf; nothing where neither is set.
std::optional<std::filesystem::path> cacheFolder();

/// trainPrior(), and how its errors are to be scaled.
PriorModel trainedModel(const std::vector<LightAndView>& samples,
                        const std::vector<LightAndView>& outputs, const TrainOptions& options,
                        const ProgressSink& progress);

/// The file in the cache for a model.
std::filesystem::path cachedModel(const std::filesystem::path& folder,
                                  const std::vector<LightAndView>& samples,
                                  const std::vector<LightAndView>& outputs,
                                  const TrainOptions& options);

/// The model for these samples and outputs: from source.file, else from the cache, else trained
/// and put into the cache, which many processes may do at once. A damaged file in the cache is
/// trained anew, with a warning.
/// Throws std::runtime_error where source.file is no model, or one of other samples or outputs.
std::shared_ptr<const PriorModel> priorFor(const std::vector<LightAndView>& samples,
                                           const std::vector<LightAndView>& outputs,
                                           const PriorSource& source, const ProgressSink& progress,
                                           const MessageSink& warn);

}  // namespace abrdf
