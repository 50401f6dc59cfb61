// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace abrdf {

/// Largest resident set of this process so far, and the present one, in bytes.
std::uint64_t peakMemory();
std::uint64_t residentMemory();

}  // namespace abrdf
