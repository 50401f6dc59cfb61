// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/angle_keys.h"

#include <doctest/doctest.h>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("the keys are found in any order, whole or decimal, and the file's own name wins") {
    const auto check = [](const char* name, double tl, double pl, double tv, double pv) {
        CAPTURE(name);
        const auto keys = angleKeysFromName(name);
        REQUIRE(keys.has_value());
        CHECK(keys->tl == tl);
        CHECK(keys->pl == pl);
        CHECK(keys->tv == tv);
        CHECK(keys->pv == pv);
    };
    check("tv015_pv060/00123 tl030 pl090 tv015 pv060.jpg", 30, 90, 15, 60);
    check("any/pv7.5_tv15 pl337.5 tl011.25.exr", 11.25, 337.5, 15, 7.5);
    check("tl000_pl000_tv000_pv000.PNG", 0, 0, 0, 0);
    check("TL30 PL90 TV45 PV-90.jpg", 30, 90, 45, -90);
    check("tv099_pv099/tl1 pl2 tv3 pv4", 1, 2, 3, 4);
    check("tv003_pv004/tl1 pl2.jpg", 1, 2, 3, 4);
}

TEST_CASE("names without all four keys are none") {
    for (const char* name : {"", "readme.txt", "tl030 pl090 tv015.jpg", "tl pl tv pv.jpg",
                             "atl030 pl090 tv015 pv060.jpg", "tlx pl090 tv015 pv060.jpg"}) {
        CAPTURE(name);
        CHECK_FALSE(angleKeysFromName(name).has_value());
    }
}

TEST_SUITE_END();
