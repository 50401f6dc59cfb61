// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace abrdf {

/// A method's answers beside those of its twin in longer floats.
struct ConditioningCurve {
    struct Point {
        double condition = 1;
        double difference = 0;  ///< Mean CIE 1976 Delta E.
    };
    std::string method;
    std::vector<Point> points;  ///< Of the steps at which it answered.
};

/// What gnuplot draws: the difference along the condition number, both logarithmic, a line a
/// method, on standard output. isPng: a PNG, else an SVG.
std::string conditioningFigureScript(const std::string& title,
                                     const std::vector<ConditioningCurve>& curves, bool isPng);

}  // namespace abrdf
