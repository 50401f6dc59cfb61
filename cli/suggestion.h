// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace abrdf {

/// "; did you mean --method?" where one of `words` is near to a command's or an option's name that
/// it is not; else empty.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace abrdf
