// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/stress/stress.h"

#include "abrdf/for_each_texel.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// Few materials to learn from, on a small grid: what is tested is the suite, not the prior.
StressOptions quick(const fs::path& folder) {
    setenv("XDG_CACHE_HOME", ABRDF_TEST_CACHE, 1);
    StressOptions options;
    options.output = folder;
    options.grid = "regular:5x8";
    options.prior.train.materials = 40;
    options.plan.name = "greedy:40";
    return options;
}

const ordered_json& row(const ordered_json& report, const std::string& name,
                        const std::string& method) {
    for (const ordered_json& result : report["results"]) {
        if (result["case"] == name && result["method"] == method) return result;
    }
    throw std::runtime_error("no such row: " + name + " " + method);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the suite finds where methods fail, draws it, and says it in a table") {
    const TemporaryFolder folder;
    StressOptions options = quick(folder.path() / "figures");
    options.methods = {"published", "nearest", "prior"};
    options.cases = {"noise", "elevations", "numbers", "grazing"};
    const ordered_json report = stress(options, {}, {});
    CHECK(report["results"].size() == 12);
    for (const char* name : {"noise", "elevations", "numbers", "grazing"}) {
        CHECK(fs::file_size(folder.path() / "figures" / (std::string(name) + ".svg")) > 1000);
        CHECK(fs::file_size(folder.path() / "figures" / (std::string(name) + ".png")) > 1000);
    }
    // Equal elevations are refused by the method that interpolates between them, with a reason.
    const ordered_json& refused = row(report, "elevations", "published");
    CHECK(refused["steps"].back()["delta_e"].is_null());
    CHECK(refused["refusal"].get<std::string>().find("elevation") != std::string::npos);
    CHECK(refused["breakdown"] != "none");
    CHECK(refused["condition"].get<double>() > 100);
    for (const ordered_json& result : report["results"]) CHECK(result["unreal_values"] == 0);
    // Without noise an error is less than with a fifth of noise.
    const ordered_json& noise = row(report, "noise", "prior");
    CHECK(noise["steps"].front()["delta_e"].get<double>() <
          noise["steps"].back()["delta_e"].get<double>());
    const std::string table = breakdownTable(report);
    CHECK(table.find("elevations") != std::string::npos);
    CHECK(table.find("published") != std::string::npos);
    std::ifstream stream(folder.path() / "figures/stress.json");
    CHECK(ordered_json::parse(stream) == report);
}

TEST_CASE("answers are held beside twins in longer floats along the condition number") {
    const TemporaryFolder folder;
    StressOptions options = quick(folder.path());
    options.methods = {"published", "rbf", "idw"};
    options.cases = {"conditioning"};
    const ordered_json report = stress(options, {}, {});
    CHECK(fs::file_size(folder.path() / "conditioning-twin.svg") > 1000);
    CHECK(fs::file_size(folder.path() / "conditioning-twin.png") > 1000);
    const ordered_json& rbf = row(report, "conditioning", "rbf")["steps"];
    CHECK(rbf.back()["condition"].get<double>() > 100 * rbf.front()["condition"].get<double>());
    for (const ordered_json& step : rbf) {
        CHECK(step["twin_delta_e"].get<double>() < 0.1);
        CHECK(step["twin_relative"].get<double>() > 0);  // Floats are no long doubles.
    }
    // Elevations that meet are refused, so there is nothing to compare.
    const ordered_json& published = row(report, "conditioning", "published")["steps"];
    CHECK(published.front().contains("twin_delta_e"));
    CHECK_FALSE(published.back().contains("twin_delta_e"));
    CHECK_FALSE(row(report, "conditioning", "idw")["steps"].front().contains("twin_delta_e"));
}

TEST_CASE("unknown cases and methods without a reconstruction are refused by name") {
    const TemporaryFolder folder;
    StressOptions options = quick(folder.path());
    options.cases = {"rain"};
    CHECK_THROWS_WITH_AS(stress(options, {}, {}), doctest::Contains("rain"), std::invalid_argument);
    options.cases = {"noise"};
    options.methods = {"measured"};
    CHECK_THROWS_AS(stress(options, {}, {}), std::invalid_argument);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("threads");

TEST_CASE("a stress report is the same on one thread and on many") {
    const TemporaryFolder folder;
    StressOptions options = quick(folder.path());
    options.methods = {"idw", "prior"};
    options.cases = {"missing", "jpeg"};
    const ordered_json many = stress(options, {}, {});
    const ThreadLimit one(1);
    CHECK(stress(options, {}, {}) == many);
}

TEST_SUITE_END();
