// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/error_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#e69f00", "#56b4e9", "#8c8c8c"};
constexpr double kPosterMicroseconds = 1e6;  ///< "About 1 s" for one ABRDF ...
constexpr double kPosterSamples = 204;
constexpr double kPosterLeast = 5.1;  ///< ... and Delta E of nine ABRDFs of UBO and UTIA.
constexpr double kPosterMost = 17.2;
constexpr double kPosterMean = 9.6;

/// One panel's abscissa.
struct Panel {
    const char* title;
    const char* label;
    double ChartPoint::*value;
    bool isOfSamples;
    double poster;  ///< Where its mark stands; 0: nowhere.
};

constexpr std::array kPanels = {
    Panel{"against time", "microseconds an ABRDF, one core", &ChartPoint::microseconds, false,
          kPosterMicroseconds},
    Panel{"against samples", "samples", &ChartPoint::bytes, true, kPosterSamples},
    Panel{"against what is stored", "bytes of the model, a texel", &ChartPoint::bytes, false, 0},
};

double abscissa(const Panel& panel, const ChartPoint& point) {
    return panel.isOfSamples ? static_cast<double>(point.samples) : point.*panel.value;
}

std::vector<std::string> methodsOf(const std::vector<ChartPoint>& points) {
    std::vector<std::string> methods;
    for (const ChartPoint& p : points) {
        if (std::ranges::find(methods, p.method) == methods.end()) methods.push_back(p.method);
    }
    return methods;
}

std::string labelOf(const ChartPoint& point) {
    return point.rank > 0 ? fmt::format("r{}", point.rank) : fmt::format("{}", point.samples);
}

/// The line of one method at full rank, over its samples.
std::vector<ChartPoint> fullLine(const std::vector<ChartPoint>& points, const std::string& method) {
    std::vector<ChartPoint> line;
    for (const ChartPoint& p : points) {
        if (p.method == method && p.rank == 0) line.push_back(p);
    }
    std::ranges::sort(line, {}, &ChartPoint::samples);
    return line;
}

/// The line of one method over its ranks: at 204 samples, else at the most there are.
std::vector<ChartPoint> rankLine(const std::vector<ChartPoint>& points, const std::string& method) {
    std::size_t samples = 0;
    for (const ChartPoint& p : points) {
        const bool isBetter = samples != 204 && (p.samples > samples || p.samples == 204);
        if (p.method == method && p.rank > 0 && isBetter) samples = p.samples;
    }
    std::vector<ChartPoint> line;
    for (const ChartPoint& p : points) {
        if (p.method == method && p.rank > 0 && p.samples == samples) line.push_back(p);
    }
    std::ranges::sort(line, {}, &ChartPoint::rank);
    return line;
}

std::string dataBlock(const std::string& name, const std::vector<ChartPoint>& line,
                      const Panel& panel) {
    std::string block = fmt::format("{} << EOD\n", name);
    for (const ChartPoint& p : line) {
        block += fmt::format("{:.6g} {:.4g} {}\n", abscissa(panel, p), std::max(p.deltaE, 1e-3),
                             labelOf(p));
    }
    return block + "EOD\n";
}

std::string posterMark(const Panel& panel, std::string& plots) {
    if (panel.poster <= 0) return {};
    plots += ", $poster using 1:2:3:4 with yerrorbars pt 4 ps 1.6 lw 2 lc rgb '#000000' notitle";
    plots += ", $poster using 1:2:5 with labels offset -1,0.2 right notitle";
    return fmt::format("$poster << EOD\n{:.6g} {} {} {} \"the poster, published\"\nEOD\n",
                       panel.poster, kPosterMean, kPosterLeast, kPosterMost);
}

std::string panelScript(const Panel& panel, const std::vector<ChartPoint>& points, bool isFirst) {
    std::string data;
    std::string plots;
    if (isFirst) {
        data += dataBlock("$front", paretoFront(points), panel);
        plots += "$front using 1:2 with steps lw 6 lc rgb '#f0e442' title 'Pareto front'";
    }
    const std::vector<std::string> methods = methodsOf(points);
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const char* color = kColors[m % kColors.size()];
        const auto add = [&](const std::string& name, const std::vector<ChartPoint>& line,
                             const char* style, const std::string& title, const char* labels) {
            if (line.empty()) return;
            data += dataBlock(name, line, panel);
            plots += fmt::format("{}{} using 1:2 with linespoints {} lc rgb '{}' {}",
                                 plots.empty() ? "" : ", ", name, style, color, title);
            plots += fmt::format(", {} using 1:2:3 with labels {} tc rgb '{}' notitle", name,
                                 labels, color);
        };
        add(fmt::format("$full{}", m), fullLine(points, methods[m]), "pt 7 ps 0.9 lw 2.5",
            fmt::format("title '{}'", methods[m]), "offset 0,0.7 font ',9'");
        if (panel.isOfSamples) continue;
        add(fmt::format("$rank{}", m), rankLine(points, methods[m]), "pt 6 ps 0.8 lw 1.2 dt 2",
            fmt::format("title '{}, by rank'", methods[m]), "offset 0,-0.8 font ',8'");
    }
    data += posterMark(panel, plots);
    return data + fmt::format("set title 'Error {}'\nset xlabel '{}'\nplot {}\n", panel.title,
                              panel.label, plots);
}

}  // namespace

std::vector<ChartPoint> paretoFront(std::vector<ChartPoint> points) {
    std::ranges::sort(points, [](const ChartPoint& a, const ChartPoint& b) {
        return a.microseconds != b.microseconds ? a.microseconds < b.microseconds
                                                : a.deltaE < b.deltaE;
    });
    std::vector<ChartPoint> front;
    for (ChartPoint& p : points) {
        if (front.empty() || p.deltaE < front.back().deltaE) front.push_back(std::move(p));
    }
    return front;
}

std::string chartScript(const std::vector<ChartPoint>& points, const std::string& note,
                        bool isPng) {
    double least = 1e9;
    double most = kPosterMost;
    for (const ChartPoint& p : points) {
        least = std::min(least, std::max(p.deltaE, 1e-3));
        most = std::max(most, p.deltaE);
    }
    std::string script = fmt::format(
        "set terminal {} size 1800,720 enhanced font 'DejaVu Sans,12' background rgb 'white'\n",
        isPng ? "pngcairo" : "svg dynamic");
    std::string quoted;
    for (const char c : note) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    script += fmt::format(
        "set encoding utf8\nset multiplot layout 1,3 title '{}' noenhanced font ',14'\n"
        "set logscale xy\nset grid xtics ytics mxtics mytics lc rgb '#d8d8d8', lc rgb '#efefef'\n"
        "set format x '10^{{%T}}'\nset ylabel 'mean ΔE (CIE 1976)'\n"
        "set yrange [{:.4g}:{:.4g}]\nset ytics (0.2,0.5,1,2,5,10,20,50)\n"
        "set offsets graph 0.04, graph 0.04, 0, 0\nset key bottom right font ',10' box opaque\n",
        quoted, least / 1.4, most * 1.5);
    for (std::size_t i = 0; i < kPanels.size(); ++i) {
        if (kPanels[i].isOfSamples) {
            script += "set format x '%g'\nset xtics (16,28,52,100,204,408)\nunset key\n";
        }
        script += panelScript(kPanels[i], points, i == 0);
        if (kPanels[i].isOfSamples) script += "set format x '10^{%T}'\nset xtics autofreq\n";
    }
    return script + "unset multiplot\n";
}

}  // namespace abrdf
