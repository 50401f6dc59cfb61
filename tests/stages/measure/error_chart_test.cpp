// SPDX-License-Identifier: BSD-3-Clause
#include "stages/measure/error_chart.h"

#include "stages/measure/gnuplot.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("the front holds what nothing else beats in both time and error") {
    const std::vector<ChartPoint> front = paretoFront({{"slow", 8, 0, 100, 1, 0},
                                                       {"beaten", 8, 0, 100, 2, 0},
                                                       {"fast", 8, 0, 1, 9, 0},
                                                       {"middle", 8, 0, 10, 3, 0},
                                                       {"worse", 8, 0, 11, 3, 0}});
    REQUIRE(front.size() == 3);
    CHECK(front[0].method == "fast");
    CHECK(front[1].method == "middle");
    CHECK(front[2].method == "slow");
}

TEST_CASE("gnuplot draws the chart, and says where it cannot") {
    const TemporaryFolder folder;
    const std::vector<ChartPoint> points = {{"prior", 52, 0, 200, 2.2, 600},
                                            {"prior", 204, 0, 400, 0.9, 2400},
                                            {"prior", 204, 8, 80, 1.9, 108},
                                            {"idw", 204, 0, 20, 4, 2400}};
    try {
        runGnuplot("set terminal dumb\nplot x\n", folder.path() / "try.txt");
    } catch (const std::runtime_error&) {
        MESSAGE("skipped: gnuplot is not installed");
        return;
    }
    runGnuplot(chartScript(points, "the cloth's chart", false), folder.path() / "a.svg");
    const std::string svg = bytesOf(folder.path() / "a.svg");
    for (const char* text :
         {"<svg", "prior, by rank", "idw", "r8", "Pareto front", "the poster, published",
          "Error against samples", "the cloth's chart"}) {
        CHECK_MESSAGE(svg.find(text) != std::string::npos, text);
    }
    runGnuplot(chartScript(points, "", true), folder.path() / "a.png");
    CHECK(bytesOf(folder.path() / "a.png").substr(1, 3) == "PNG");
    CHECK_THROWS_AS(runGnuplot("plot nothing(\n", folder.path() / "none.svg"), std::runtime_error);
    CHECK(!std::filesystem::exists(folder.path() / "none.svg"));
}

TEST_SUITE_END();
