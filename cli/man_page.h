// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace abrdf {

/// The manual page abrdf(1) in roff, from the program's own description of its commands.
std::string manPage(const CLI::App& program);

}  // namespace abrdf
