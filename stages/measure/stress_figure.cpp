// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/stress_figure.h"

#include "stages/measure/figure_colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

constexpr double kLeast = 0.02;  ///< Delta E at the foot of the axis.
constexpr double kMost = 200;

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// Labels of ticks are formats.
std::string quotedTick(const std::string& text) {
    std::string result;
    for (const char c : text) result += c == '%' ? std::string("%%") : std::string(1, c);
    return quoted(result);
}

std::string dataOf(const StressCurve& curve, std::size_t index) {
    std::string data = fmt::format("$c{} << EOD\n", index);
    for (std::size_t i = 0; i < curve.errors.size(); ++i) {
        const double error = curve.errors[i];
        data += std::isfinite(error)
                    ? fmt::format("{} {:.6g}\n", i, std::clamp(error, kLeast, kMost))
                    : std::string("\n");
    }
    data += "EOD\n";
    if (curve.breakdown) {
        const double error = curve.errors[*curve.breakdown];
        data += fmt::format("$b{} << EOD\n{} {:.6g}\nEOD\n", index, *curve.breakdown,
                            std::isfinite(error) ? std::clamp(error, kLeast, kMost) : kMost);
    }
    return data;
}

}  // namespace

std::string stressFigureScript(const StressFigure& figure, bool isPng) {
    std::string script = fmt::format(
        "set terminal {} size 900,560 enhanced font 'DejaVu Sans,11' background rgb 'white'\n"
        "set encoding utf8\nset title {} noenhanced\nset xlabel {} noenhanced\n"
        "set ylabel 'mean ΔE (CIE 1976)'\nset logscale y\nset yrange [{}:{}]\n"
        "set ytics (0.02,0.05,0.1,0.2,0.5,1,2,5,10,20,50,100)\nset grid ytics lc rgb '#d8d8d8'\n"
        "set xrange [-0.4:{}]\nset key outside right noenhanced\n",
        isPng ? "pngcairo" : "svg", quoted(figure.title), quoted(figure.axis), kLeast, kMost,
        static_cast<double>(figure.labels.size()) - 0.6);
    std::string ticks;
    for (std::size_t i = 0; i < figure.labels.size(); ++i) {
        ticks += fmt::format("{}{} {}", i > 0 ? ", " : "", quotedTick(figure.labels[i]), i);
    }
    script += fmt::format("set xtics ({}) noenhanced{}\n", ticks,
                          figure.labels.size() > 8 ? " rotate by -30" : "");
    std::string plots = "3 lc rgb '#b0b0b0' dt 2 notitle";
    for (std::size_t i = 0; i < figure.curves.size(); ++i) {
        const StressCurve& curve = figure.curves[i];
        const char* color = kFigureColors[i % kFigureColors.size()];
        script += dataOf(curve, i);
        plots +=
            fmt::format(", $c{} using 1:2 with {} pt 7 ps 0.8 lw 2 lc rgb '{}' title {}", i,
                        figure.kindsOnly ? "points" : "linespoints", color, quoted(curve.method));
        if (curve.breakdown) {
            plots += fmt::format(
                ", $b{} using 1:2 with points pt 6 ps 2.2 lw 2 lc rgb '{}' notitle", i, color);
        }
    }
    return script + "plot " + plots + "\n";
}

}  // namespace abrdf
