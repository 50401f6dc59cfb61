// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace abrdf {

/// One method at one size, over all materials.
struct ChartPoint {
    std::string method;
    std::size_t samples = 0;
    int rank = 0;             ///< 0: full.
    double microseconds = 0;  ///< An ABRDF, one core.
    double deltaE = 0;        ///< Mean CIE 1976.
    double bytes = 0;         ///< Of the model, an ABRDF.
};

/// Those that no other one beats in both time and error, the fastest first.
std::vector<ChartPoint> paretoFront(std::vector<ChartPoint> points);

/// What gnuplot draws: error against time with the Pareto front and the poster's mark, against
/// samples, and against bytes; logarithmic, a line a method. note: a line below the title.
/// isPng: a PNG, else an SVG; on standard output.
std::string chartScript(const std::vector<ChartPoint>& points, const std::string& note, bool isPng);

}  // namespace abrdf
