// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/output_file.h"
#include "cli/command.h"

#include <fmt/format.h>

#include <iostream>

namespace abrdf {

void addInputOptions(CLI::App& command, InputOptions& options) {
    command.add_option("INPUT", options.input, "folder or .zip of a BTF database")->required();
    command.add_option("--colorconfig", options.colorConfig,
                       "OpenColorIO config (else $OCIO, else the shipped one)");
    command.add_option("--input-space", options.inputSpace,
                       "colour space of the images (else the database's convention)");
    const std::map<std::string, MissingImages> policies = {{"error", MissingImages::kError},
                                                           {"fill", MissingImages::kFill}};
    command.add_option("--missing", options.missing, "needed images that are absent: error | fill")
        ->transform(CLI::CheckedTransformer(policies));
}

void addPlanOptions(CLI::App& command, PlanOptions& options) {
    command.add_option("--plan", options.plan, "which samples to take: poster[:N]")
        ->capture_default_str();
    command
        .add_option("--elevations", options.elevations,
                    "the slices' two elevations in degrees, as 30,75")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--alpha", options.alpha, "the slices' offset in degrees")
        ->capture_default_str();
    command.add_option("--axial", options.axial, "samples of an axial slice (24)");
    command.add_option("--diagonal", options.diagonal, "samples of a diagonal slice (27)");
}

SlicePlan chosenPlan(const PlanOptions& options) {
    SlicePlan plan = slicePlanFromName(options.plan);
    if (!options.elevations.empty()) {
        plan.elevations.clear();
        for (const double degrees : options.elevations) {
            plan.elevations.push_back(radiansFromDegrees(degrees));
        }
    }
    plan.alpha = radiansFromDegrees(options.alpha);
    if (options.axial != 0) plan.axialCount = options.axial;
    if (options.diagonal != 0) plan.diagonalCount = options.diagonal;
    checkPlan(plan);
    return plan;
}

void deliver(const nlohmann::ordered_json& report, const std::string& text,
             const SharedOptions& shared) {
    const std::string json = report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
    if (!shared.report.empty()) writeWholeFile(shared.report, json + "\n");
    std::cout << (shared.json ? json + "\n" : text) << std::flush;
    if (!std::cout) throw std::runtime_error("standard output cannot be written");
}

}  // namespace abrdf
