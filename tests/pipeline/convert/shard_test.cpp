// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/shard.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a shard is I/N with I from 1 to N") {
    CHECK(shardFromText("3/4").index == 3);
    CHECK(shardFromText("3/4").count == 4);
    for (const char* text : {"", "0/4", "5/4", "1", "1/", "a/b", "1/2/3", "-1/2"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(shardFromText(text), std::invalid_argument);
    }
}

TEST_SUITE_END();
