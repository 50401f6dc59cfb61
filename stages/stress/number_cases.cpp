// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers that are no light, or hardly a number.
#include "stages/stress/stress_case.h"

#include <array>
#include <limits>

namespace abrdf {

namespace {

struct BadNumber {
    const char* name;
    float value;
};

constexpr std::array kBadNumbers{
    BadNumber{"none", 0},
    BadNumber{"NaN", std::numeric_limits<float>::quiet_NaN()},
    BadNumber{"infinity", std::numeric_limits<float>::infinity()},
    BadNumber{"denormal", 1e-40F},
    BadNumber{"-1e30", -1e30F},
    BadNumber{"65504", 65504},
    BadNumber{"1e30", 1e30F},
};

constexpr double kShare = 0.05;

}  // namespace

std::vector<StressCase> numberCases() {
    StressCase numbers{"numbers", "bad numbers in 5 % of the samples", "number", true, true, {},
                       {}};
    for (std::size_t i = 0; i < kBadNumbers.size(); ++i) {
        numbers.steps.push_back({static_cast<double>(i), kBadNumbers[i].name});
    }
    numbers.trial = [](const StressMaterial& material, double index) {
        const auto kind = static_cast<std::size_t>(index);
        StressTrial trial;
        trial.truth = material;
        if (kind == 0) return trial;
        trial.measured = [value = material.value, bad = kBadNumbers[kind].value](
                             const LightAndView& pair, Random& random) {
            return random.chance(kShare) ? Rgb{bad, bad, bad} : value(pair);
        };
        return trial;
    };
    StressCase units{"unit",
                     "the same material in another unit",
                     "factor on all values",
                     true,
                     true,
                     stepsOf({1, 1e-4, 1e-2, 1e2, 1e4}),
                     {}};
    units.trial = [](const StressMaterial& material, double factor) {
        const auto f = static_cast<float>(factor);
        StressTrial trial;
        trial.truth = {material.name,
                       [value = material.value, f](const LightAndView& p) { return f * value(p); }};
        trial.exposure = 1 / factor;
        return trial;
    };
    return {numbers, units};
}

}  // namespace abrdf
