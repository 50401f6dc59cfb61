// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/stopwatch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

using abrdf::Stopwatch;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a stopwatch measures seconds, each from when it was made") {
    using Clock = std::chrono::steady_clock;
    const auto before = Clock::now();
    const Stopwatch first;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const Stopwatch second;
    const double ofSecond = second.seconds();
    const double ofFirst = first.seconds();
    const std::chrono::duration<double> all = Clock::now() - before;
    CHECK(ofFirst >= 0.02);
    CHECK(ofFirst <= all.count());
    CHECK(ofSecond >= 0);
    CHECK(ofSecond <= all.count() - 0.02);
}

TEST_SUITE_END();
