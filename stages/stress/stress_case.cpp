// SPDX-License-Identifier: BSD-3-Clause
#include "stages/stress/stress_case.h"

#include <fmt/format.h>

#include <algorithm>

namespace abrdf {

std::vector<StressCase> stressCases() {
    std::vector<StressCase> all;
    for (const auto& page : {noiseCases, highlightCases, rangeCases, missingCases, angleCases,
                             planCases, degenerateCases, colorCases, grazingCases, spatialCases,
                             numberCases, conditioningCases}) {
        std::ranges::move(page(), std::back_inserter(all));
    }
    return all;
}

std::vector<StressStep> stepsOf(const std::vector<double>& values, double factor,
                                const std::string& unit) {
    std::vector<StressStep> steps;
    for (const double value : values) {
        steps.push_back({value, fmt::format("{:g}{}", factor * value, unit)});
    }
    return steps;
}

std::optional<std::size_t> breakdownStep(std::span<const double> errors) {
    constexpr double kVisible = 3;
    if (errors.empty()) return std::nullopt;
    const double bound = std::max(2 * errors[0], kVisible);
    const auto first =
        std::ranges::find_if(errors, [&](double error) { return !(error <= bound); });
    if (first == errors.end()) return std::nullopt;
    return static_cast<std::size_t>(first - errors.begin());
}

}  // namespace abrdf
