// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/sample_plan.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

using namespace abrdf;

namespace {

std::size_t distinctOn(const AngularGrid& grid, const SamplePlan& plan) {
    std::set<std::size_t> pairs;
    for (const LightAndView& s : plan.samples) {
        pairs.insert(grid.pairIndex(nearestDirection(grid.lights(), s.light),
                                    nearestDirection(grid.views(), s.view)));
    }
    return pairs.size();
}

std::size_t subspacesOf(const SamplePlan& plan) {
    std::set<std::pair<long, long>> subspaces;
    for (const LightAndView& s : plan.samples) {
        subspaces.emplace(std::lround(degreesFromRadians(s.light.theta)),
                          std::lround(degreesFromRadians(s.view.theta)));
    }
    return subspaces.size();
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("an axial slice keeps the azimuths' difference, a diagonal one their sum") {
    const Slice axial{SliceKind::kAxial, 0.5, 1.0, radiansFromDegrees(70), 12, 0.1, 1};
    for (const LightAndView& s : samplesOf(axial)) {
        CHECK(wrappedAzimuth(s.view.phi - s.light.phi) == doctest::Approx(radiansFromDegrees(70)));
    }
    const Slice diagonal{SliceKind::kDiagonal, 0.5, 1.0, radiansFromDegrees(70), 9, 0, 1.5};
    std::set<long> differences;
    for (const LightAndView& s : samplesOf(diagonal)) {
        const Radians sum = wrappedAzimuth(s.view.phi + s.light.phi);
        CHECK(std::abs(std::sin((sum - radiansFromDegrees(70)) / 2)) < 1e-9);
        const Radians turn = wrappedAzimuth(s.view.phi - s.light.phi);
        differences.insert(std::lround(1e6 * std::min(turn, 2 * kPi - turn)));
    }
    // It starts at the mirror, and its odd count repeats no difference but by symmetry.
    const LightAndView first = samplesOf(diagonal).front();
    CHECK(wrappedAzimuth(first.view.phi - first.light.phi) == doctest::Approx(kPi));
    CHECK(differences.size() >= 5);
}

TEST_CASE("the plans hold what their names say") {
    const AngularGrid grid(ubo81Directions());
    CHECK(subspacesOf(eightPlan(0, &grid)) == 4);
    CHECK(subspacesOf(sixteenSlicesPlan(0, &grid)) == 16);
    for (const std::size_t bound : {0U, 28U, 52U, 100U, 204U}) {
        const std::size_t most = bound > 0 ? bound : kPlanSamples;
        for (const AngularGrid* snapTo : {static_cast<const AngularGrid*>(nullptr), &grid}) {
            const SamplePlan eight = eightPlan(bound, snapTo);
            const SamplePlan sixteen = sixteenSlicesPlan(bound + (bound == 28 ? 4 : 0), snapTo);
            const std::size_t count =
                snapTo != nullptr ? distinctOn(grid, eight) : eight.samples.size();
            CHECK(count <= most);
            CHECK(count > 0.8 * static_cast<double>(most));
            CHECK((snapTo != nullptr ? distinctOn(grid, sixteen) : sixteen.samples.size()) <=
                  most + 4);
        }
    }
    CHECK(eightPlan(52, nullptr).name == "eight:52");
    CHECK_THROWS_AS(sixteenSlicesPlan(20, nullptr), std::invalid_argument);
}

TEST_CASE("plan names are a word and a number") {
    CHECK(planNameFrom("greedy").bound == 0);
    CHECK(planNameFrom("greedy:52").bound == 52);
    CHECK(planNameFrom("eight:8").base == "eight");
    for (const char* name : {"greedy:", "greedy:x", "greedy:7", "greedy:52x", "greedy:-5"}) {
        CHECK_THROWS_AS(planNameFrom(name), std::invalid_argument);
    }
}

TEST_CASE("the pairs that are built in are pairs of UBO2003, each once") {
    const std::vector<std::size_t>& pairs = greedyPairsOfUbo81();
    CHECK(pairs.size() == 408);
    CHECK(std::set<std::size_t>(pairs.begin(), pairs.end()).size() == pairs.size());
    for (const std::size_t pair : pairs) CHECK(pair < 6561);
}

TEST_SUITE_END();
