// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// Errors of one method along the steps of a case; NaN: it refused.
struct StressCurve {
    std::string method;
    std::vector<double> errors;
    std::optional<std::size_t> breakdown = {};  ///< The step where it breaks down.
};

struct StressFigure {
    std::string title;
    std::string axis;
    bool kindsOnly = false;           ///< Steps are kinds: points without a line.
    std::vector<std::string> labels;  ///< A step each.
    std::vector<StressCurve> curves;
};

/// What gnuplot draws: Delta E (logarithmic) along the steps, a line a method, a ring where it
/// breaks down, the bound of 3. isPng: a PNG, else an SVG; on standard output.
std::string stressFigureScript(const StressFigure& figure, bool isPng);

}  // namespace abrdf
