// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace abrdf {

/// Adds to a report, as "estimate", what a method expects of its Delta E: the mean over the texels
/// and their 95 % quantile. deltaE: a texel's each; NaN, where it knows none, is left out. Nothing
/// is added where none is known.
void addEstimate(std::vector<float> deltaE, nlohmann::ordered_json& report);

}  // namespace abrdf
