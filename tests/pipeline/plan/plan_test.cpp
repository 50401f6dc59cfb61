// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan.h"

#include "pipeline/plan/expected_error.h"
#include "pipeline/plan/plan_choice.h"
#include "pipeline/plan/plan_file.h"
#include "pipeline/plan/plan_report.h"
#include "stages/slice/choose_samples.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <set>

using namespace abrdf;

namespace {

PlanJob smallJob(const TemporaryFolder& folder) {
    PlanJob job;
    job.samples = 12;
    job.materials = 20;
    job.output = folder.path() / "plan.toml";
    return job;
}

SamplePlan readBack(const std::string& name, const AngularGrid& grid) {
    return planFor(methodFromName("prior"), {.name = name}, grid, {}, false, {}, {});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a plan reads back on its own grid to the pairs that were chosen, and so its prefixes") {
    const TemporaryFolder folder;
    for (const char* name : {"dome151", "regular:4x6", "ubo81"}) {
        PlanJob job = smallJob(folder);
        job.grid = name;
        const auto report = plan(job, {});
        const AngularGrid grid = gridFromName(name);
        CHECK(report["grid"]["lights"] == grid.lights().size());
        const SamplePlan plan = readBack(job.output.string(), grid);
        REQUIRE(plan.samples.size() == 12);
        const SamplePlan inFile = planFromFile(job.output);
        for (std::size_t i = 0; i < plan.samples.size(); ++i) {
            // Six digits of a degree are what the file keeps.
            CHECK(squaredDistance(plan.samples[i], inFile.samples[i]) < 1e-11);
        }
        const SampleSet set = chooseSamples(plan, grid, SampleWish::kMeasuredPairs);
        CHECK(set.count() == 12);
        const SamplePlan prefix = readBack(job.output.string() + ":8", grid);
        CHECK(prefix.name == plan.name + ":8");
        CHECK(std::equal(prefix.samples.begin(), prefix.samples.end(), plan.samples.begin()));
        CHECK(prefix.samples.size() == 8);
        CHECK(readBack(job.output.string() + ":100", grid).samples == plan.samples);
    }
}

TEST_CASE("slices of a goniometer come with their travel, their order and what they cost") {
    const TemporaryFolder folder;
    PlanJob job = smallJob(folder);
    job.grid = "regular:4x8";
    job.continuous = true;
    job.elevations = {25, 50, 75};
    job.samples = 40;
    const auto report = plan(job, {});
    const auto count = report["plan"]["samples"].get<std::size_t>();
    CHECK(count <= 40);
    CHECK(count >= 36);
    CHECK(report["expected_error"].size() == count);
    CHECK(report["free"]["delta_e"] < report["expected_error"].back());
    CHECK(report["travel"]["sample"] > 0);
    std::size_t inSlices = 0;
    for (const auto& slice : report["slices"]) inSlices += slice["samples"].get<std::size_t>();
    CHECK(inSlices == count);
    std::ifstream stream(job.output);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    CHECK(text.find("sweep = [") != std::string::npos);
    CHECK(text.find("expected_error = [") != std::string::npos);
    CHECK(planFromFile(job.output).samples.size() == count);
    CHECK(planSummary(report).find("travel: light") != std::string::npos);
}

TEST_CASE("plans that nothing could make are refused, and leave no file") {
    const TemporaryFolder folder;
    for (const auto& spoil : std::vector<void (*)(PlanJob&)>{
             [](PlanJob& j) { j.samples = 0; }, [](PlanJob& j) { j.grid = "nonsense"; },
             [](PlanJob& j) {
                 j.grid = "regular:1x3";
                 j.samples = 10;
             },
             [](PlanJob& j) { j.travel = -1; },
             [](PlanJob& j) {
                 j.continuous = true;
                 j.elevations = {95};
             },
             [](PlanJob& j) {
                 j.continuous = true;
                 j.samples = 2;
             }}) {
        PlanJob job = smallJob(folder);
        spoil(job);
        CHECK_THROWS_AS(plan(job, {}), std::invalid_argument);
        CHECK_FALSE(std::filesystem::exists(job.output));
    }
    const AngularGrid grid(regularDirections(3, 4));
    for (const double snap : {-1.0, 181.0, std::nan("")}) {
        CHECK_THROWS_AS(planFor(methodFromName("prior"), {.name = "eight", .snap = snap}, grid, {},
                                false, {}, {}),
                        std::invalid_argument);
    }
    CHECK_THROWS_AS(
        planFor(methodFromName("prior"), {.name = "eight", .snap = 1}, grid, {}, false, {}, {}),
        std::runtime_error);
}

TEST_CASE("the expected error rises with what is left open, and doubling is judged by its gain") {
    CHECK(expectedErrorOf(0) == 0);
    CHECK(expectedErrorOf(9) > expectedErrorOf(8));
    std::vector<double> errors;
    for (int n = 1; n <= 64; ++n) errors.push_back(8.0 / n);
    // 8 / n - 4 / n falls below 0.1 beyond 40: not within half of 64.
    CHECK_FALSE(whereMoreStopPaying(errors));
    for (int n = 65; n <= 128; ++n) errors.push_back(8.0 / n);
    CHECK(whereMoreStopPaying(errors) == std::size_t{41});
    CHECK(whereMoreStopPaying(std::vector<double>{5, 4.9}) == std::size_t{1});
}

TEST_SUITE_END();
