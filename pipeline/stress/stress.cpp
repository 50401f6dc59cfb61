// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress.h"

#include "abrdf/output_file.h"
#include "pipeline/json_text.h"
#include "pipeline/stress/stress_drawing.h"
#include "pipeline/stress/stress_run.h"
#include "pipeline/stress/stress_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace abrdf {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

ordered_json stress(const StressOptions& options, const ProgressSink& progress,
                    const MessageSink& warn) {
    const auto [cases, grid, methods, materials] = setUpStress(options, progress, warn);
    const std::vector<StressMaterial> none(1);
    fs::create_directories(options.output);

    ordered_json report = {{"command", "stress"}, {"version", ABRDF_VERSION}};
    report["materials"] = ordered_json::array();
    for (const StressMaterial& material : materials) report["materials"].push_back(material.name);
    report["seed"] = options.seed;
    report["results"] = ordered_json::array();
    for (const StressCase& stressCase : cases) {
        StressRun run(stressCase, stressCase.ofAnyMaterial ? materials : none, methods, grid,
                      options);
        run.run(progress, warn);
        std::vector<ordered_json> results;
        for (std::size_t m = 0; m < methods.size(); ++m) results.push_back(run.resultOf(m));
        drawStress(stressCase, results, options.output);
        for (ordered_json& result : results) report["results"].push_back(std::move(result));
    }
    writeWholeFile(options.output / "stress.json", jsonText(report, 2) + "\n");
    return report;
}

std::string breakdownTable(const ordered_json& report) {
    std::vector<std::string> methods;
    std::vector<std::string> cases;
    std::map<std::pair<std::string, std::string>, std::string> cells;
    const auto addOnce = [](std::vector<std::string>& list, const std::string& name) {
        if (std::ranges::find(list, name) == list.end()) list.push_back(name);
    };
    for (const ordered_json& result : report["results"]) {
        addOnce(methods, result["method"]);
        addOnce(cases, result["case"]);
        cells[{result["case"], result["method"]}] = result["breakdown"];
    }
    std::string table = fmt::format("{:<18}", "breaks down at");
    for (const std::string& method : methods) table += fmt::format("{:>13}", method);
    for (const std::string& name : cases) {
        table += fmt::format("\n{:<18}", name);
        for (const std::string& method : methods) {
            table += fmt::format("{:>13}", cells[{name, method}].substr(0, 12));
        }
    }
    return table + "\n";
}

}  // namespace abrdf
