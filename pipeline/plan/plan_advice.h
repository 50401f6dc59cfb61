// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace abrdf {

/// Mean CIE 1976 Delta E that `prior` is expected to come to with a named plan of so many samples:
/// interpolated among what eleven materials gave (tests/bench/README.md). Nothing for plans that
/// were not measured.
std::optional<double> expectedDeltaE(const std::string& plan, std::size_t samples);

/// One line on what another plan with as many images is estimated to give instead of `plan`; empty
/// where none is known to be better, or `plan` was not measured.
std::string planAdvice(const std::string& plan, std::size_t samples);

}  // namespace abrdf
