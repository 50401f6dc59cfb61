// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/sample_plan.h"

#include <filesystem>
#include <string>
#include <vector>

namespace abrdf {

/// A plan as `abrdf plan` writes it, or a CSV with a row theta_i,phi_i,theta_v,phi_v in degrees a
/// sample (a header line and lines that begin with # are passed over).
/// TOML: `name`, and `samples`, an array of [theta_i, phi_i, theta_v, phi_v] in their order.
/// Throws std::runtime_error that names the file and what is wrong.
SamplePlan planFromFile(const std::filesystem::path& file);

/// What is known of a plan beside its samples.
struct PlanNotes {
    std::vector<double> expectedError;       ///< Delta E after each sample; empty: not known.
    std::vector<std::size_t> sweep = {};     ///< An order to measure in; empty: as they stand.
    std::vector<std::string> comments = {};  ///< A line each.
};

/// The text of a plan file that planFromFile() reads.
std::string planText(const SamplePlan& plan, const PlanNotes& notes);

}  // namespace abrdf
