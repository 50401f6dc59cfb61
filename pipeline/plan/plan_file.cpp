// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan_file.h"

#include "abrdf/number_rows.h"
#include "abrdf/text_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostSamples = 100000;

LightAndView checkedSample(const std::array<double, 4>& degrees, const std::string& where) {
    const auto isDirection = [](double theta, double phi) {
        return theta >= 0 && theta < 90 && phi >= -360 && phi <= 720;
    };
    if (!isDirection(degrees[0], degrees[1]) || !isDirection(degrees[2], degrees[3])) {
        throw std::runtime_error(fmt::format(
            "{}: {:g}, {:g}, {:g}, {:g} are not theta_i, phi_i, theta_v, phi_v in degrees, both "
            "thetas from 0 to below 90",
            where, degrees[0], degrees[1], degrees[2], degrees[3]));
    }
    const auto direction = [](double theta, double phi) {
        return Direction{radiansFromDegrees(theta), wrappedAzimuth(radiansFromDegrees(phi))};
    };
    return {direction(degrees[0], degrees[1]), direction(degrees[2], degrees[3])};
}

SamplePlan planFromToml(const fs::path& file) {
    toml::table table;
    try {
        table = toml::parse(textOfFile(file), file.string());
    } catch (const toml::parse_error& error) {
        throw std::runtime_error(fmt::format("{}:{}: is not TOML: {}", file.string(),
                                             error.source().begin.line,
                                             std::string(error.description())));
    }
    SamplePlan plan{file.filename().string(), {}, {}};
    if (const auto name = table["name"].value<std::string>()) plan.name = *name;
    const toml::array* samples = table["samples"].as_array();
    if (samples == nullptr) {
        throw std::runtime_error(fmt::format("{}: has no array `samples`", file.string()));
    }
    for (const toml::node& node : *samples) {
        const std::string where = fmt::format("{}:{}", file.string(), node.source().begin.line);
        const toml::array* row = node.as_array();
        std::array<double, 4> degrees{};
        if (row == nullptr || row->size() != degrees.size()) {
            throw std::runtime_error(
                fmt::format("{}: a sample is [theta_i, phi_i, theta_v, phi_v]", where));
        }
        for (std::size_t i = 0; i < degrees.size(); ++i) {
            const auto number = row->get(i)->value<double>();
            if (!number) throw std::runtime_error(fmt::format("{}: is not four numbers", where));
            degrees[i] = *number;
        }
        plan.samples.push_back(checkedSample(degrees, where));
    }
    return plan;
}

SamplePlan planFromCsv(const fs::path& file) {
    SamplePlan plan{file.filename().string(), {}, {}};
    const NumberRows table =
        numberRowsFromFile(file, 4, 4, "theta_i,phi_i,theta_v,phi_v in degrees");
    for (const auto& [where, numbers] : table.rows) {
        plan.samples.push_back(
            checkedSample({numbers[0], numbers[1], numbers[2], numbers[3]}, where));
    }
    return plan;
}

/// A TOML string.
std::string quoted(const std::string& text) {
    std::ostringstream stream;
    stream << toml::value<std::string>(text);
    return stream.str();
}

}  // namespace

SamplePlan planFromFile(const fs::path& file) {
    SamplePlan plan = file.extension() == ".toml" ? planFromToml(file) : planFromCsv(file);
    if (plan.samples.empty() || plan.samples.size() > kMostSamples) {
        throw std::runtime_error(fmt::format("{}: holds {} samples; a plan has 1 to {}",
                                             file.string(), plan.samples.size(), kMostSamples));
    }
    return plan;
}

std::string planText(const SamplePlan& plan, const PlanNotes& notes) {
    std::string text;
    for (const std::string& comment : notes.comments) text += fmt::format("# {}\n", comment);
    text += fmt::format("name = {}\n", quoted(plan.name));
    if (!notes.expectedError.empty()) {
        text += fmt::format(
            "# Delta E after each sample, as far as random materials tell\n"
            "expected_error = [{:.3f}]\n",
            fmt::join(notes.expectedError, ", "));
    }
    if (!notes.sweep.empty()) {
        text += fmt::format(
            "# an order to measure the samples in, from 0: light, sensor and sample turn little\n"
            "sweep = [{}]\n",
            fmt::join(notes.sweep, ", "));
    }
    text += "# theta_i, phi_i, theta_v, phi_v in degrees\nsamples = [\n";
    for (const LightAndView& s : plan.samples) {
        text += fmt::format("    [{:.6g}, {:.6g}, {:.6g}, {:.6g}],\n",
                            degreesFromRadians(s.light.theta), degreesFromRadians(s.light.phi),
                            degreesFromRadians(s.view.theta), degreesFromRadians(s.view.phi));
    }
    return text + "]\n";
}

}  // namespace abrdf
