// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress_drawing.h"

#include "stages/measure/conditioning_figure.h"
#include "stages/measure/gnuplot.h"
#include "stages/measure/stress_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

StressFigure figureOf(const StressCase& stressCase, const std::vector<ordered_json>& results) {
    StressFigure figure;
    figure.title = fmt::format("{}: {}", stressCase.name, stressCase.title);
    figure.axis = stressCase.axis;
    figure.kindsOnly = stressCase.kindsOnly;
    for (const StressStep& step : stressCase.steps) figure.labels.push_back(step.label);
    for (const ordered_json& result : results) {
        StressCurve curve{result["method"], {}, {}};
        for (const ordered_json& step : result["steps"]) {
            curve.errors.push_back(step["delta_e"].is_null()
                                       ? std::numeric_limits<double>::quiet_NaN()
                                       : step["delta_e"].get<double>());
        }
        curve.breakdown = breakdownStep(curve.errors);
        figure.curves.push_back(std::move(curve));
    }
    return figure;
}

std::vector<ConditioningCurve> conditioningCurves(const std::vector<ordered_json>& results) {
    std::vector<ConditioningCurve> curves;
    for (const ordered_json& result : results) {
        ConditioningCurve curve{result["method"], {}};
        for (const ordered_json& step : result["steps"]) {
            if (step.contains("twin_delta_e")) {
                curve.points.push_back({step["condition"], step["twin_delta_e"]});
            }
        }
        std::ranges::stable_sort(curve.points, {}, &ConditioningCurve::Point::condition);
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    return curves;
}

}  // namespace

void drawStress(const StressCase& stressCase, const std::vector<ordered_json>& results,
                const fs::path& folder) {
    const StressFigure figure = figureOf(stressCase, results);
    const fs::path base = folder / stressCase.name;
    runGnuplot(stressFigureScript(figure, false), fs::path(base) += ".svg");
    runGnuplot(stressFigureScript(figure, true), fs::path(base) += ".png");
    if (const auto curves = conditioningCurves(results); !curves.empty()) {
        const std::string title = stressCase.name + ": what rounding does to an answer";
        const fs::path twins = folder / (stressCase.name + "-twin");
        runGnuplot(conditioningFigureScript(title, curves, false), fs::path(twins) += ".svg");
        runGnuplot(conditioningFigureScript(title, curves, true), fs::path(twins) += ".png");
    }
}

}  // namespace abrdf
