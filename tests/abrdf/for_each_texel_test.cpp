// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/for_each_texel.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("threads");

TEST_CASE("every texel is visited once, whatever the number of threads") {
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        std::vector<int> visits(1000);
        forEachTexel(visits.size(), [&](std::size_t i) { ++visits[i]; });
        forEachImage(visits.size(), [&](std::size_t i) { ++visits[i]; });
        forEachTexelBlock(visits.size(), 33, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) ++visits[i];
        });
        CHECK(visits == std::vector<int>(1000, 3));
    }
}

TEST_CASE("a sum has the same bits on 1, 2 and 7 threads") {
    const auto sum = [](int threads) {
        const ThreadLimit limit(threads);
        return sumOverTexels(12345, [](std::size_t i) { return std::sin(static_cast<double>(i)); });
    };
    CHECK(sum(1) == sum(2));
    CHECK(sum(1) == sum(7));
    CHECK(sumOverTexels(0, [](std::size_t) { return 1.0; }) == 0);
}

TEST_CASE("what a body throws arrives at the caller") {
    CHECK_THROWS_AS(forEachTexel(500,
                                 [](std::size_t i) {
                                     if (i == 321) throw std::runtime_error("321");
                                 }),
                    std::runtime_error);
}

TEST_SUITE_END();
