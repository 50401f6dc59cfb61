// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan_report.h"

#include "pipeline/plan/expected_error.h"
#include "pipeline/plan/plan_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

double degreesOf(Radians angle) {
    return std::round(10 * degreesFromRadians(angle)) / 10;
}

ordered_json jsonOf(const Travel& travel) {
    return {{"light", degreesOf(travel.light)},
            {"sensor", degreesOf(travel.sensor)},
            {"sample", degreesOf(travel.sample)}};
}

ordered_json jsonOf(const Slice& slice) {
    return {{"kind", slice.kind == SliceKind::kAxial ? "axial" : "diagonal"},
            {"theta_i", degreesOf(slice.thetaLight)},
            {"theta_v", degreesOf(slice.thetaView)},
            {"alpha", degreesOf(slice.offset)},
            {"samples", slice.count}};
}

ordered_json stepsOf(const std::vector<double>& errors) {
    ordered_json steps = ordered_json::array();
    for (std::size_t count : {8U, 16U, 28U, 52U, 100U, 204U, 408U, 816U}) {
        if (count >= errors.size()) break;
        steps.push_back({{"samples", count}, {"delta_e", errors[count - 1]}});
    }
    steps.push_back({{"samples", errors.size()}, {"delta_e", errors.back()}});
    return steps;
}

}  // namespace

ordered_json reportOf(const PlannedSamples& planned) {
    const auto enough = whereMoreStopPaying(planned.errors);
    ordered_json report = {
        {"command", "plan"},
        {"version", ABRDF_VERSION},
        {"plan", {{"name", planned.plan.name}, {"samples", planned.plan.samples.size()}}},
        {"grid",
         {{"lights", planned.grid.lights().size()}, {"views", planned.grid.views().size()}}},
        {"candidates", planned.candidates},
        {"expected_error", planned.errors},
        {"steps", stepsOf(planned.errors)},
        {"enough", enough ? ordered_json(*enough) : ordered_json()},
        {"travel", jsonOf(planned.sweptTravel())}};
    if (planned.freeError) {
        report["free"] = {{"delta_e", *planned.freeError}, {"travel", jsonOf(planned.freeTravel)}};
        report["slices"] = ordered_json::array();
        for (const Slice& slice : planned.slices) report["slices"].push_back(jsonOf(slice));
    }
    return report;
}

std::string planFileText(const PlannedSamples& planned) {
    const Travel travel = planned.sweptTravel();
    PlanNotes notes;
    notes.expectedError = planned.errors;
    notes.sweep = planned.sweep;
    notes.comments = {
        fmt::format("abrdf {} plan: every prefix is a plan; FILE:N takes the first N samples",
                    ABRDF_VERSION),
        fmt::format("in the order of `sweep` the light turns by {:.0f}, the sensor by {:.0f}, the "
                    "sample by {:.0f} degrees",
                    degreesFromRadians(travel.light), degreesFromRadians(travel.sensor),
                    degreesFromRadians(travel.sample))};
    for (const Slice& slice : planned.slices) {
        const ordered_json s = jsonOf(slice);
        notes.comments.push_back(fmt::format("{} theta_i {:g} theta_v {:g} alpha {:g}: {} samples",
                                             s["kind"].get<std::string>(),
                                             s["theta_i"].get<double>(), s["theta_v"].get<double>(),
                                             s["alpha"].get<double>(), slice.count));
    }
    return planText(planned.plan, notes);
}

std::string planSummary(const ordered_json& report) {
    const auto travelText = [](const ordered_json& travel) {
        return fmt::format("light {:.0f}, sensor {:.0f}, sample {:.0f} degrees",
                           travel["light"].get<double>(), travel["sensor"].get<double>(),
                           travel["sample"].get<double>());
    };
    std::string text = "samples  expected Delta E\n";
    for (const ordered_json& step : report["steps"]) {
        text += fmt::format("{:7}  {:.2f}\n", step["samples"].get<std::size_t>(),
                            step["delta_e"].get<double>());
    }
    text += report["enough"].is_null()
                ? std::string("more samples pay to the end\n")
                : fmt::format("from {} samples on twice as many gain less than 10 % or 0.1\n",
                              report["enough"].get<std::size_t>());
    text += fmt::format("travel: {}\n", travelText(report["travel"]));
    if (report.contains("free")) {
        text +=
            fmt::format("{} slices; as many single samples at their places: {:.2f}, travel: {}\n",
                        report["slices"].size(), report["free"]["delta_e"].get<double>(),
                        travelText(report["free"]["travel"]));
    }
    return text +
           fmt::format("{}: {} samples, {:.1f} s\n", report["output"]["path"].get<std::string>(),
                       report["plan"]["samples"].get<std::size_t>(), report["time"].get<double>());
}

}  // namespace abrdf
