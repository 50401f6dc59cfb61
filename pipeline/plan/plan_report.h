// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/plan/planned_samples.h"

#include <nlohmann/json.hpp>

#include <string>

namespace abrdf {

/// What the report of plan() says of the samples: all of it but its output and time.
nlohmann::ordered_json reportOf(const PlannedSamples& planned);

/// The file of a plan, for --plan, with comments for its reader.
std::string planFileText(const PlannedSamples& planned);

/// The report as a few lines for a terminal.
std::string planSummary(const nlohmann::ordered_json& report);

}  // namespace abrdf
