// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report_files.h"

#include "abrdf/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

using nlohmann::json;

namespace {

/// report[keys...], or null where one is absent.
json valueAt(const json& report, std::initializer_list<const char*> keys) {
    const json* at = &report;
    for (const char* key : keys) {
        if (!at->is_object() || !at->contains(key)) return nullptr;
        at = &(*at)[key];
    }
    return *at;
}

std::string textAt(const json& report, const char* key) {
    const json value = valueAt(report, {key});
    return value.is_string() ? value.get<std::string>() : "";
}

/// The parts of a page that reports fill, made when the first row comes.
class Collector {
  public:
    explicit Collector(PageContent& content) : content_(content) {}

    void addEvaluate(const json& report) {
        for (const json& r : report.at("results")) {
            evaluations_.rows.push_back(
                {report.at("input"), r.at("method"), valueAt(r, {"plan"}), valueAt(r, {"samples"}),
                 valueAt(r, {"images_read"}), r.at("delta_e"), valueAt(r, {"delta_e_2000"}),
                 valueAt(r, {"rmse"}), valueAt(r, {"psnr"}), valueAt(r, {"stops"}),
                 valueAt(r, {"highlight", "delta_e"}), valueAt(r, {"highlight", "psnr"}),
                 valueAt(r, {"microseconds_per_abrdf"})});
            addPoint(r, textAt(report, "input"));
        }
    }

    void addChart(const json& report) {
        for (const json& r : report.at("results")) addPoint(r, textAt(r, "input"));
    }

    void addStress(const json& report) {
        if (matrix_.columns.empty()) {
            matrix_.title = "Stability";
            matrix_.note =
                "Where each method breaks down: the first step of a case whose error exceeds twice "
                "its harmless value or 3 ΔE, whichever is larger. A dash: nowhere in the sweep.";
            matrix_.columns = {"Case"};
        }
        for (const json& r : report.at("results")) {
            const std::string method = r.at("method").get<std::string>();
            const auto column = std::ranges::find(matrix_.columns, method);
            const auto index = static_cast<std::size_t>(column - matrix_.columns.begin());
            if (column == matrix_.columns.end()) matrix_.columns.push_back(method);
            auto row = std::ranges::find_if(
                matrix_.rows, [&](const auto& cells) { return cells.front() == r.at("case"); });
            if (row == matrix_.rows.end()) {
                matrix_.rows.push_back({r.at("case")});
                row = std::prev(matrix_.rows.end());
            }
            if (row->size() <= index) row->resize(index + 1);
            (*row)[index] = valueAt(r, {"breakdown"});
        }
    }

    void addConvert(const json& report) {
        const json texels = valueAt(report, {"texels"});
        const json bytes = valueAt(report, {"peak_memory"});
        conversions_.rows.push_back(
            {report.at("output").at("path"), report.at("method"), valueAt(report, {"plan", "name"}),
             valueAt(report, {"plan", "samples"}), valueAt(report, {"plan", "images_read"}),
             texels.is_array() && texels.size() == 2
                 ? json(fmt::format("{} x {}", texels[0].dump(), texels[1].dump()))
                 : json(),
             valueAt(report, {"time", "total"}),
             bytes.is_number() ? json(bytes.get<double>() / 1e6) : json()});
    }

    void finish() {
        if (!evaluations_.rows.empty()) {
            evaluations_.title = "Reconstruction against the full measurement";
            evaluations_.note =
                "The poster's measures over all pairs of directions, natural and highlight "
                "exposure. Click a heading, or press Enter on it, to sort.";
            evaluations_.columns = {"Material", "Method", "Plan",         "Samples",
                                    "Images",   "ΔE 76",  "ΔE 2000",      "RMSE",
                                    "PSNR dB",  "Stops",  "highlight ΔE", "highlight PSNR",
                                    "µs/ABRDF"};
            content_.tables.push_back(std::move(evaluations_));
        }
        if (!conversions_.rows.empty()) {
            conversions_.title = "Atlases made";
            conversions_.columns = {"Atlas",  "Method", "Plan",    "Samples",
                                    "Images", "Texels", "Seconds", "Memory MB"};
            content_.tables.push_back(std::move(conversions_));
        }
        for (auto& row : matrix_.rows) row.resize(matrix_.columns.size());
        if (!matrix_.rows.empty()) content_.matrices.push_back(std::move(matrix_));
    }

  private:
    void addPoint(const json& r, const std::string& input) {
        const json time = valueAt(r, {"microseconds_per_abrdf"});
        if (!time.is_number()) return;
        const json samples = valueAt(r, {"samples"});
        content_.points.push_back({r.at("method").get<std::string>(), input, time.get<double>(),
                                   r.at("delta_e").get<double>(),
                                   samples.is_number() ? samples.get<int>() : 0});
    }

    PageContent& content_;
    PageDataTable evaluations_;
    PageDataTable conversions_;
    PageDataTable matrix_;
};

json readJson(const std::filesystem::path& file) {
    const std::string text = textOfFile(file);
    // Copies of values go as deep into the stack as these are nested.
    constexpr int kDeepest = 100;
    const auto checkDepth = [&](int depth, json::parse_event_t, const json&) {
        if (depth <= kDeepest) return true;
        throw std::runtime_error(fmt::format("{}: is nested more than {} deep, which no report is",
                                             file.string(), kDeepest));
    };
    try {
        return json::parse(text, checkDepth);
    } catch (const json::exception& error) {
        throw std::runtime_error(fmt::format("{}: is no JSON: {}; remove it from the folder",
                                             file.string(), error.what()));
    }
}

}  // namespace

std::vector<std::string> addReports(const std::vector<std::filesystem::path>& files,
                                    PageContent& content) {
    Collector collector(content);
    std::vector<std::string> others;
    for (const std::filesystem::path& file : files) {
        const json report = readJson(file);
        const std::string command = textAt(report, "command");
        try {
            if (command == "evaluate") {
                collector.addEvaluate(report);
            } else if (command == "chart") {
                collector.addChart(report);
            } else if (command == "stress") {
                collector.addStress(report);
            } else if (command == "convert") {
                collector.addConvert(report);
            } else {
                others.push_back(file.filename().string());
            }
        } catch (const json::exception& error) {
            throw std::runtime_error(
                fmt::format("{}: is no whole report of abrdf {}: {}; make it again, or remove it",
                            file.string(), command, error.what()));
        }
    }
    collector.finish();
    return others;
}

}  // namespace abrdf
