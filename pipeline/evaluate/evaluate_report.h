// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/measure/measures.h"
#include "stages/measure/seen_images.h"

#include <nlohmann/json.hpp>

#include <string>

namespace abrdf {

/// Measures as the report of `evaluate` says them.
nlohmann::ordered_json jsonOf(const Accuracy& accuracy);
nlohmann::ordered_json jsonOf(const TexelMeasures& texels, const SeenMeasures& seen);

/// The poster's table of such a report, as text with one row a method and a heading; where there
/// are texels, a second table of them.
std::string tableOf(const nlohmann::ordered_json& report);

}  // namespace abrdf
