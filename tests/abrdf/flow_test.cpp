// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/flow.h"

#include "abrdf/cancel.h"
#include "abrdf/for_each_texel.h"

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("threads");

TEST_CASE("items are fetched and delivered in order, slots are never shared, and none is lost") {
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        for (const std::size_t slots : {1U, 2U, 5U}) {
            std::vector<std::size_t> slot(slots);
            std::vector<std::size_t> delivered;
            std::size_t fetched = 0;
            std::size_t mostUnderWay = 0;
            std::atomic<std::size_t> left = 0;
            Flow flow;
            flow.items = 100;
            flow.slots = slots;
            flow.fetch = [&](std::size_t item, std::size_t s) {
                CHECK(item == fetched++);
                mostUnderWay = std::max(mostUnderWay, fetched - left);
                slot[s] = item;
            };
            flow.work = [&](std::size_t item, std::size_t s) {
                if (slot[s] == item) slot[s] = item * item;
            };
            flow.deliver = [&](std::size_t, std::size_t s) {
                delivered.push_back(slot[s]);
                ++left;
            };
            runFlow(flow);
            REQUIRE(delivered.size() == 100);
            for (std::size_t i = 0; i < 100; ++i) CHECK(delivered[i] == i * i);
            CHECK(mostUnderWay <= slots);
        }
    }
}

TEST_CASE("what is thrown in any step arrives at the caller") {
    const auto thrower = [](std::size_t item, std::size_t) {
        if (item == 17) throw std::runtime_error("17");
    };
    for (int step = 0; step < 3; ++step) {
        Flow flow;
        flow.items = 50;
        flow.slots = 3;
        (step == 0 ? flow.fetch : step == 1 ? flow.work : flow.deliver) = thrower;
        CHECK_THROWS_AS(runFlow(flow), std::runtime_error);
    }
    runFlow({0, 1, {}, thrower, {}});  // No item, no step.
}

TEST_SUITE_END();
