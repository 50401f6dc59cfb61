// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

struct PlanFigure {
    const char* plan;
    double samples;
    double deltaE;
};

/// `prior`, natural exposure, ten measured materials and the rendered twill.
constexpr std::array kFigures{
    PlanFigure{"eight", 52, 3.48},     PlanFigure{"eight", 100, 2.93},
    PlanFigure{"eight", 204, 2.89},    PlanFigure{"poster", 204, 3.53},
    PlanFigure{"slices16", 204, 1.44}, PlanFigure{"greedy", 52, 2.16},
    PlanFigure{"greedy", 100, 1.61},   PlanFigure{"greedy", 204, 0.93},
};

/// Within a fifth of the counts that were measured; beyond, nothing is known.
constexpr double kReach = 1.2;

std::string baseOf(const std::string& plan) {
    return plan.substr(0, plan.find(':'));
}

}  // namespace

std::optional<double> expectedDeltaE(const std::string& plan, std::size_t samples) {
    const std::string base = baseOf(plan);
    const auto wanted = static_cast<double>(samples);
    const PlanFigure* below = nullptr;
    const PlanFigure* above = nullptr;
    for (const PlanFigure& figure : kFigures) {
        if (base != figure.plan) continue;
        if (figure.samples <= wanted) below = &figure;
        if (figure.samples >= wanted && above == nullptr) above = &figure;
    }
    if (below == nullptr && above == nullptr) return std::nullopt;
    if (below == nullptr || above == nullptr || below == above) {
        const PlanFigure& only = below != nullptr ? *below : *above;
        const double ratio = std::max(wanted / only.samples, only.samples / wanted);
        if (ratio > kReach) return std::nullopt;
        return only.deltaE;
    }
    // Straight in logarithms of both.
    const double share =
        std::log(wanted / below->samples) / std::log(above->samples / below->samples);
    return below->deltaE * std::pow(above->deltaE / below->deltaE, share);
}

std::string planAdvice(const std::string& plan, std::size_t samples) {
    const auto own = expectedDeltaE(plan, samples);
    if (!own) return {};
    const char* best = nullptr;
    double least = *own;
    for (const char* other : {"slices16", "greedy"}) {
        const auto expected = expectedDeltaE(other, samples);
        if (expected && *expected < least) {
            least = *expected;
            best = other;
        }
    }
    if (best == nullptr) return {};
    return fmt::format(
        "with as many images --plan {}:{} is estimated to come to {:.1f} Delta E where {} comes to "
        "{:.1f} (means of eleven materials)",
        best, samples, least, baseOf(plan), *own);
}

}  // namespace abrdf
