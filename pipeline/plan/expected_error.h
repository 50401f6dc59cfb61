// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// Mean CIE 1976 Delta E at natural exposure that `prior` is expected to come to where a plan
/// leaves this deviation, in L* (GreedyChoice::deviation): a power law through the errors of random
/// materials that no training has seen. 0 for 0.
double expectedErrorOf(double deviation);
std::vector<double> expectedErrorsOf(std::span<const double> deviations);

/// From this many samples on, twice as many gain less than 10 % or less than 0.1 Delta E. errors:
/// expected after each sample; nothing where that lies beyond half of them.
std::optional<std::size_t> whereMoreStopPaying(std::span<const double> errors);

}  // namespace abrdf
