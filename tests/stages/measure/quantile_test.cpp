// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/quantile.h"

#include <doctest/doctest.h>

namespace abrdf {

TEST_SUITE("unit") {
    TEST_CASE("a quantile lies linearly between the two values of neighbouring rank") {
        const std::vector<float> values{40, 10, 30, 20};
        CHECK(quantile(values, 0) == doctest::Approx(10));
        CHECK(quantile(values, 0.5) == doctest::Approx(25));
        CHECK(quantile(values, 0.9) == doctest::Approx(37));  // numpy.quantile gives 37.
        CHECK(quantile(values, 1) == doctest::Approx(40));
    }

    TEST_CASE("any quantile of one value is that value, and 0 of none") {
        CHECK(quantile({7}, 0.995) == 7);
        CHECK(quantile({}, 0.5) == 0);
    }
}

}  // namespace abrdf
