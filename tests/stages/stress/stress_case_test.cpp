// SPDX-License-Identifier: BSD-3-Clause
#include "stages/stress/stress_case.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

using namespace abrdf;

namespace {

const StressCase& caseNamed(const std::vector<StressCase>& all, const std::string& name) {
    const auto found = std::ranges::find(all, name, &StressCase::name);
    REQUIRE(found != all.end());
    return *found;
}

std::vector<LightAndView> somePairs() {
    std::vector<LightAndView> pairs;
    for (const SlicePlan plan; const LightAndView& pair : plan.samples()) pairs.push_back(pair);
    return pairs;
}

std::vector<Rgb> measured(const StressTrial& trial, std::uint64_t seed) {
    Random random(seed);
    std::vector<Rgb> values;
    for (const LightAndView& pair : somePairs()) {
        values.push_back(trial.measured ? trial.measured(pair, random) : trial.truth.value(pair));
    }
    return values;
}

std::size_t keptOf(const StressTrial& trial) {
    if (!trial.kept) return somePairs().size();
    Random random(1);
    const std::vector<bool> kept = trial.kept(somePairs(), random);
    return static_cast<std::size_t>(std::ranges::count(kept, true));
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a method breaks down at twice its harmless error or 3, whichever is larger") {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const auto step = [](std::vector<double> errors) { return breakdownStep(errors); };
    CHECK_FALSE(step({1, 2, 3}));
    CHECK(step({1, 2, 3.01, 9}) == 2);
    CHECK_FALSE(step({2, 3.5, 4}));
    CHECK(step({2, 3.5, 4.1}) == 2);
    CHECK(step({1, kNaN, 1}) == 1);
    CHECK(step({kNaN}) == 0);
    CHECK_FALSE(step({}));
}

TEST_CASE("every case has a name of its own, begins harmlessly, and repeats itself") {
    std::set<std::string> names;
    for (const StressCase& c : stressCases()) {
        CAPTURE(c.name);
        CHECK(names.insert(c.name).second);
        REQUIRE_FALSE(c.steps.empty());
        for (const StressMaterial& material : stressMaterials()) {
            for (const StressStep& step : c.steps) {
                const StressTrial trial = c.trial(material, step.value);
                REQUIRE(trial.truth.value);
                if (&material != &stressMaterials().front() && !c.ofAnyMaterial) continue;
                const std::vector<Rgb> once = measured(trial, 7);
                const std::vector<Rgb> again = measured(trial, 7);
                CHECK(std::equal(once.begin(), once.end(), again.begin(), [](Rgb a, Rgb b) {
                    return a == b || (!isFinite(a) && !isFinite(b));
                }));
            }
            if (!c.ofAnyMaterial) break;
        }
    }
    CHECK(names.size() >= 20);
}

TEST_CASE("the harmless step of a defect of samples measures the truth") {
    const StressMaterial material = stressMaterials()[1];
    for (const StressCase& c : stressCases()) {
        // What JPEG and 16 bits leave is near the truth, not the truth.
        if (!c.ofAnyMaterial || c.name == "jpeg" || c.name == "bits") continue;
        CAPTURE(c.name);
        const StressTrial trial = c.trial(material, c.steps.front().value);
        const std::vector<Rgb> values = measured(trial, 3);
        const std::vector<LightAndView> pairs = somePairs();
        for (std::size_t k = 0; k < pairs.size(); ++k) {
            const Rgb truth = trial.truth.value(pairs[k]);
            CHECK(std::abs(values[k].g - std::min(truth.g, c.name == "clipped" ? 2.0F : 1e9F)) <
                  1e-5F);
        }
        CHECK(keptOf(trial) == pairs.size());
    }
}

TEST_CASE("noise has the deviation that it says, and JPEG a little of its own") {
    const auto all = stressCases();
    const StressMaterial matt = stressMaterials()[0];
    const StressTrial noisy = caseNamed(all, "noise").trial(matt, 0.1);
    const StressTrial jpeg = caseNamed(all, "jpeg").trial(matt, 95);
    double noise = 0;
    double blocks = 0;
    Random random(5);
    const auto pairs = somePairs();
    for (const LightAndView& pair : pairs) {
        const double truth = static_cast<double>(matt.value(pair).r);
        const double off = static_cast<double>(noisy.measured(pair, random).r) / truth - 1;
        noise += off * off;
        const double byJpeg = static_cast<double>(jpeg.measured(pair, random).r) / truth - 1;
        blocks += byJpeg * byJpeg;
    }
    const auto n = static_cast<double>(pairs.size());
    CHECK(std::sqrt(noise / n) == doctest::Approx(0.1).epsilon(0.15));
    CHECK(std::sqrt(blocks / n) > 0.005);
    CHECK(std::sqrt(blocks / n) < 0.1);
}

TEST_CASE("missing samples are as many as were said, by chance, by subspace and by light") {
    const auto all = stressCases();
    const StressMaterial matt = stressMaterials()[0];
    CHECK(keptOf(caseNamed(all, "missing").trial(matt, 0.5)) == 102);
    CHECK(keptOf(caseNamed(all, "missing").trial(matt, 1)) == 1);
    CHECK(keptOf(caseNamed(all, "missing-subspace").trial(matt, 1)) == 153);
    CHECK(keptOf(caseNamed(all, "missing-subspace").trial(matt, 3)) == 51);
    CHECK(keptOf(caseNamed(all, "missing-light").trial(matt, 1)) < 204);
}

TEST_CASE("parallax displaces what is seen from the side, and nothing from above") {
    const StressTrial trial = caseNamed(stressCases(), "parallax").trial(stressMaterials()[0], 2);
    Random random(1);
    const LightAndView above{{0.5, 1}, {0, 0}};
    CHECK(trial.measured(above, random).r == doctest::Approx(trial.truth.value(above).r));
    const LightAndView aside{{0.5, 1}, {1.2, 0.4}};
    CHECK(std::abs(trial.measured(aside, random).r / trial.truth.value(aside).r - 1) > 0.05F);
}

TEST_CASE("a turned material is the material, turned") {
    const StressMaterial satin = stressMaterials()[2];
    const StressMaterial after = turned(satin, 0.7);
    const LightAndView pair{{0.6, 0.2}, {0.9, 3}};
    const LightAndView moved{{0.6, 0.9}, {0.9, 3.7}};
    CHECK(after.value(moved).g == doctest::Approx(satin.value(pair).g));
    CHECK(after.value(pair).g != doctest::Approx(satin.value(pair).g));
}

TEST_SUITE_END();
