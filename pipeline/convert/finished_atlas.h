// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/stopwatch.h"
#include "pipeline/convert/convert_job.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// With --resume an atlas that is finished already is kept: is the output there, whole, and of the
/// job `asked` (askedOf()) and its `shard`? Throws std::runtime_error where it is of another job.
bool isFinished(const ConvertOptions& options, const nlohmann::ordered_json& asked, int shard);

/// The report of a job that was finished before. time: since this run began.
nlohmann::ordered_json finishedReport(const ConvertJob& job, const ConvertOptions& options,
                                      const Stopwatch& time);

}  // namespace abrdf
