// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/chart.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "pipeline/chart/method_figures.h"
#include "pipeline/chart/virtual_subject.h"
#include "stages/measure/error_chart.h"
#include "stages/measure/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// The SVG's and the PNG's name.
std::vector<fs::path> picturesOf(const fs::path& output) {
    if (output.empty()) return {};
    if (output.extension() != ".svg" && output.extension() != ".png") {
        throw std::invalid_argument(
            fmt::format("{}: a chart is an .svg or a .png; the other one is written beside it",
                        output.string()));
    }
    return {fs::path(output).replace_extension(".svg"), fs::path(output).replace_extension(".png")};
}

void checkOptions(const ChartOptions& options) {
    if (options.inputs.empty() && !options.calibrate) {
        throw std::invalid_argument("a chart needs at least one input; --calibrate does without");
    }
    if (!(options.trial.exposure > 0)) throw std::invalid_argument("the exposure must be above 0");
    for (const std::size_t count : options.samples) {
        if (count < 8 || count > 100000) {
            throw std::invalid_argument(fmt::format(
                "{} samples are not a size that a plan can have: use 8 to 100000", count));
        }
    }
    for (const int rank : options.ranks) {
        if (rank < 1) throw std::invalid_argument("a rank is at least 1");
    }
    for (const fs::path& file : picturesOf(options.output)) checkOutputPath(file);
    if (!options.csv.empty()) checkOutputPath(options.csv);
}

std::vector<std::string> methodsOf(const ChartOptions& options) {
    if (!options.methods.empty()) return options.methods;
    std::vector<std::string> names;
    for (const Method& method : methods()) names.emplace_back(method.name);
    return names;
}

ordered_json jsonOf(const Trial& t, const std::string& input) {
    return {{"method", t.size.method},
            {"input", input},
            {"plan", t.plan},
            {"samples", t.samples},
            {"rank", t.size.rank},
            {"images_read", t.images},
            {"delta_e", t.accuracy.natural.deltaE},
            {"delta_e_2000", t.accuracy.natural.deltaE2000},
            {"rmse", t.accuracy.natural.rmse},
            {"psnr", t.accuracy.natural.psnr},
            {"stops", t.accuracy.stops},
            {"highlight",
             {{"delta_e", t.accuracy.highlight.deltaE}, {"psnr", t.accuracy.highlight.psnr}}},
            {"microseconds_per_abrdf", t.time.oneCore},
            {"microseconds_all_cores", t.time.allCores},
            {"multiply_adds", t.multiplyAdds},
            {"model_bytes", t.modelBytes},
            {"set_up_milliseconds", t.setUpMilliseconds}};
}

ordered_json jsonOf(const MethodFigure& f) {
    return {{"method", f.size.method},
            {"samples", f.size.samples},
            {"rank", f.size.rank},
            {"delta_e", f.deltaE},
            {"delta_e_worst", f.worstDeltaE},
            {"psnr", f.psnr},
            {"psnr_worst", f.worstPsnr},
            {"stops", f.stops},
            {"microseconds_per_abrdf", f.microseconds},
            {"microseconds_all_cores", f.microsecondsAllCores},
            {"multiply_adds", f.multiplyAdds},
            {"model_bytes", f.modelBytes},
            {"images_read", f.images},
            {"set_up_milliseconds", f.setUpMilliseconds}};
}

/// Every size on one subject; a plan that this grid is too small for is passed over.
std::vector<Trial> trialsOn(const Subject& subject, const std::vector<MethodSize>& sizes,
                            const TrialOptions& options, std::size_t done, std::size_t total,
                            const ProgressSink& progress, const MessageSink& warn) {
    std::vector<Trial> trials;
    for (const MethodSize& size : sizes) {
        if (size.samples <= subject.grid.pairCount()) {
            trials.push_back(tryMethod(size, subject, options, progress, warn));
        }
        if (progress) progress({"chart", "trials", ++done, total});
    }
    return trials;
}

/// The known errors with times of this machine.
std::vector<MethodFigure> timedAnew(const TrialOptions& options, const ProgressSink& progress,
                                    const MessageSink& warn) {
    std::vector<MethodFigure> figures = shippedFigures();
    const Subject subject = virtualSubject(AngularGrid(ubo81Directions()));
    for (std::size_t i = 0; i < figures.size(); ++i) {
        const Trial trial = tryMethod(figures[i].size, subject, options, progress, warn);
        figures[i].microseconds = trial.time.oneCore;
        figures[i].microsecondsAllCores = trial.time.allCores;
        figures[i].setUpMilliseconds = trial.setUpMilliseconds;
        if (progress) progress({"chart", "trials", i + 1, figures.size()});
    }
    return figures;
}

std::vector<ChartPoint> pointsOf(const std::vector<MethodFigure>& figures) {
    std::vector<ChartPoint> points;
    for (const MethodFigure& f : figures) {
        points.push_back(
            {f.size.method, f.size.samples, f.size.rank, f.microseconds, f.deltaE, f.modelBytes});
    }
    return points;
}

}  // namespace

ordered_json chart(const ChartOptions& options, const ProgressSink& progress,
                   const MessageSink& warn) {
    checkOptions(options);
    const std::vector<MethodSize> sizes =
        methodSizes(methodsOf(options), options.samples, options.ranks);
    ordered_json report = {{"command", "chart"}, {"version", ABRDF_VERSION}};
    report["exposure"] = options.trial.exposure;
    report["threads"] = availableThreads();
    report["inputs"] = ordered_json::array();
    report["results"] = ordered_json::array();
    std::vector<Trial> trials;
    for (const InputOptions& input : options.inputs) {
        const Subject subject = readSubject(input, progress);
        report["inputs"].push_back(subject.name);
        const std::size_t done = (report["inputs"].size() - 1) * sizes.size();
        for (Trial& trial : trialsOn(subject, sizes, options.trial, done,
                                     sizes.size() * options.inputs.size(), progress, warn)) {
            report["results"].push_back(jsonOf(trial, subject.name));
            trials.push_back(std::move(trial));
        }
    }
    const std::vector<MethodFigure> figures =
        options.inputs.empty() ? timedAnew(options.trial, progress, warn) : figuresOf(trials);
    const std::vector<ChartPoint> points = pointsOf(figures);
    report["summary"] = ordered_json::array();
    for (const MethodFigure& f : figures) report["summary"].push_back(jsonOf(f));
    report["pareto"] = ordered_json::array();
    for (const ChartPoint& p : paretoFront(points)) {
        report["pareto"].push_back({{"method", p.method},
                                    {"samples", p.samples},
                                    {"rank", p.rank},
                                    {"delta_e", p.deltaE},
                                    {"microseconds_per_abrdf", p.microseconds}});
    }
    report["output"] = ordered_json::array();
    if (!options.csv.empty()) {
        writeWholeFile(options.csv, csvOf(figures));
        report["output"].push_back(options.csv.string());
    }
    if (options.calibrate) report["calibration"] = keepFigures(figures).string();
    const std::string note =
        fmt::format("abrdf: accuracy against speed, {} material{}", options.inputs.size(),
                    options.inputs.size() == 1 ? "" : "s in the mean");
    for (const fs::path& file : picturesOf(options.output)) {
        runGnuplot(chartScript(points, note, file.extension() == ".png"), file);
        report["output"].push_back(file.string());
    }
    return report;
}

std::string chartTable(const ordered_json& report) {
    std::string table =
        fmt::format("{:<12}{:>8}{:>6} |{:>8}{:>8}{:>8}{:>8} |{:>10}{:>10}{:>12}{:>10}{:>8}\n",
                    "method", "samples", "rank", "dE76", "worst", "PSNR", "stops", "us/ABRDF",
                    "all cores", "mult-adds", "bytes", "set-up");
    for (const ordered_json& r : report["summary"]) {
        const auto number = [&](const char* key) { return r[key].get<double>(); };
        table += fmt::format(
            "{:<12}{:>8}{:>6} |{:>8.2f}{:>8.2f}{:>8.1f}{:>8.2f} |{:>10.1f}{:>10.1f}{:>12.3g}"
            "{:>10.0f}{:>8.1f}\n",
            r["method"].get<std::string>(), r["samples"].get<std::size_t>(),
            r["rank"] == 0 ? std::string("full") : r["rank"].dump(), number("delta_e"),
            number("delta_e_worst"), number("psnr"), number("stops"),
            number("microseconds_per_abrdf"), number("microseconds_all_cores"),
            number("multiply_adds"), number("model_bytes"), number("set_up_milliseconds"));
    }
    return table;
}

}  // namespace abrdf
