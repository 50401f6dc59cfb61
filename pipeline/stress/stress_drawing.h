// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/stress/stress_case.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <vector>

namespace abrdf {

/// Draws the figure of a case, SVG and PNG, into `folder`: a curve a method over the case's steps;
/// where the methods have twins in longer floats, a second figure, of what rounding does.
/// results: of each method, as StressRun::resultOf(). Throws as runGnuplot().
void drawStress(const StressCase& stressCase, const std::vector<nlohmann::ordered_json>& results,
                const std::filesystem::path& folder);

}  // namespace abrdf
