// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/conditioning_figure.h"

#include "stages/measure/figure_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace abrdf {

std::string conditioningFigureScript(const std::string& title,
                                     const std::vector<ConditioningCurve>& curves, bool isPng) {
    constexpr double kLeast = 1e-7;  // Floats tell no less.
    constexpr double kMost = 100;
    double largest = 10;
    for (const ConditioningCurve& curve : curves) {
        for (const auto& point : curve.points) largest = std::max(largest, point.condition);
    }
    std::string script = fmt::format(
        "set terminal {} size 900,560 enhanced font 'DejaVu Sans,11' background rgb 'white'\n"
        "set encoding utf8\nset title '{}' noenhanced\n"
        "set xlabel 'condition number of the method''s worst system'\n"
        "set ylabel 'difference from the twin in longer floats, mean ΔE (CIE 1976)'\n"
        "set logscale xy\nset xrange [1:{:.3g}]\nset yrange [{}:{}]\n"
        "set format xy '10^{{%T}}'\nset grid lc rgb '#d8d8d8'\nset key outside right noenhanced\n"
        "set label 'visible: 3' at graph 0.02, first 5\n",
        isPng ? "pngcairo" : "svg", title, 3 * largest, kLeast, kMost);
    std::string plots = "3 lc rgb '#b0b0b0' dt 2 notitle";
    for (std::size_t i = 0; i < curves.size(); ++i) {
        if (curves[i].points.empty()) continue;
        script += fmt::format("$c{} << EOD\n", i);
        for (const auto& point : curves[i].points) {
            script += fmt::format("{:.6g} {:.6g}\n", point.condition,
                                  std::clamp(point.difference, kLeast, kMost));
        }
        script += "EOD\n";
        plots += fmt::format(
            ", $c{} using 1:2 with linespoints pt {} ps 0.9 lw 2 lc rgb '{}' title '{}'", i, 5 + i,
            kFigureColors[i % kFigureColors.size()], curves[i].method);
    }
    return script + "plot " + plots + "\n";
}

}  // namespace abrdf
