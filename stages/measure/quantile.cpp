// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/quantile.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace abrdf {

double quantile(std::vector<float> values, double q) {
    assert(q >= 0 && q <= 1);
    if (values.empty()) return 0;

    const double rank = q * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(below);
    std::nth_element(values.begin(), place, values.end());
    const double lower = *place;
    if (below + 1 == values.size()) return lower;

    const double upper = *std::min_element(place + 1, values.end());
    return lower + (rank - static_cast<double>(below)) * (upper - lower);
}

}  // namespace abrdf
