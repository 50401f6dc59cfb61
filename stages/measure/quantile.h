// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace abrdf {

/// The q-quantile, q in 0 .. 1, interpolated linearly between the two neighbours of rank
/// q (n - 1), as numpy does it. values: in any order, none of them NaN; 0 where there are none.
double quantile(std::vector<float> values, double q);

}  // namespace abrdf
