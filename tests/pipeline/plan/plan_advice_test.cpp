// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan_advice.h"

#include <doctest/doctest.h>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("what a plan is expected to give is measured at its counts and lies between, between") {
    CHECK(expectedDeltaE("greedy", 204) == doctest::Approx(0.93));
    CHECK(expectedDeltaE("greedy:100", 100) == doctest::Approx(1.61));
    const auto between = expectedDeltaE("greedy:150", 150);
    REQUIRE(between);
    CHECK(*between < 1.61);
    CHECK(*between > 0.93);
    CHECK(expectedDeltaE("eight", 190) == expectedDeltaE("eight:190", 190));
    CHECK_FALSE(expectedDeltaE("greedy", 8));
    CHECK_FALSE(expectedDeltaE("poster", 52));
    CHECK_FALSE(expectedDeltaE("my.toml", 204));
}

TEST_CASE("advice names a better plan with as many images, and none to those who have the best") {
    const std::string advice = planAdvice("eight", 204);
    CHECK(advice.find("greedy:204") != std::string::npos);
    CHECK(advice.find("0.9") != std::string::npos);
    CHECK(advice.find("2.9") != std::string::npos);
    CHECK(planAdvice("greedy", 204).empty());
    CHECK(planAdvice("my.toml", 204).empty());
}

TEST_SUITE_END();
