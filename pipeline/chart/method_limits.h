// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/chart/method_figures.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace abrdf {

/// What a user is ready to pay, or to bear.
struct MethodLimits {
    std::optional<double> budget;     ///< Microseconds an ABRDF, one core, > 0.
    std::optional<double> tolerance;  ///< Mean CIE 1976 Delta E, > 0.
    bool strict = false;              ///< Limits that nothing meets are an error.
    bool methodIsOpen = true;         ///< False: the user named one.
};

/// "50us", "1.5ms", "2s" in microseconds. Throws std::invalid_argument.
double microsecondsFromText(const std::string& text);

/// The figure to take: with a tolerance the one of fewest samples, then of least time, within both
/// limits; with a budget alone the most accurate within it. `isMet` is false where nothing is: then
/// it is the nearest to the limits. figures: at least one.
struct LimitedChoice {
    MethodFigure figure;
    bool isMet = true;
};
LimitedChoice chooseWithin(std::vector<MethodFigure> figures, const MethodLimits& limits);

/// Settles method, plan and rank by the known figures; times are scaled to `pairs` of the output.
/// A method or plan that the user named is kept. Returns what was chosen and why, for the report;
/// null without limits. Throws std::invalid_argument for impossible limits, std::runtime_error
/// where nothing meets strict ones.
nlohmann::ordered_json settleMethod(MethodChoice& choice, const MethodLimits& limits,
                                    std::size_t pairs, const MessageSink& warn);

}  // namespace abrdf
