// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/slice_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace abrdf {

std::vector<LightAndView> SlicePlan::samples() const {
    std::vector<LightAndView> all;
    for (std::size_t s = 0; s < subspaceCount(); ++s) {
        for (int k = 0; k < axialCount; ++k) {
            const Radians phiLight = 2 * kPi * k / axialCount;
            all.push_back(
                {{thetaLight(s), phiLight}, {thetaView(s), wrappedAzimuth(phiLight + alpha)}});
        }
        for (int k = 0; k < diagonalCount; ++k) {
            const Radians phiView = 2 * kPi * k / diagonalCount;
            all.push_back({{thetaLight(s), wrappedAzimuth(2 * kPi - phiView + alpha)},
                           {thetaView(s), phiView}});
        }
    }
    return all;
}

SlicePlan slicePlanFromName(const std::string& name) {
    SlicePlan plan;
    const std::size_t colon = name.find(':');
    if (name.substr(0, colon) != plan.name) {
        throw std::invalid_argument(
            fmt::format("there is no plan '{}': the plan is poster or poster:N", name));
    }
    if (colon == std::string::npos) return plan;
    int samples = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + colon + 1, end, samples);
    if (error != std::errc() || rest != end || samples < 8) {
        throw std::invalid_argument(fmt::format(
            "the plan '{}' needs a number of samples of at least 8 after its colon, as poster:204",
            name));
    }
    const int subspace = std::min(samples, 4 * 720) / 4;
    plan.axialCount = std::clamp(subspace * 24 / 51, 1, 360);
    plan.diagonalCount = std::clamp(subspace - plan.axialCount, 1, 360);
    plan.name = name;
    return plan;
}

void checkPlan(const SlicePlan& plan) {
    if (plan.elevations.size() != 2) {
        throw std::invalid_argument(
            fmt::format("the poster's plan needs two elevations, as 30,75; there are {}",
                        plan.elevations.size()));
    }
    for (const Radians theta : plan.elevations) {
        if (!(theta > 0 && theta < kPi / 2)) {
            throw std::invalid_argument(
                fmt::format("the elevation {} degrees of the plan is not between 0 and 90",
                            degreesFromRadians(theta)));
        }
    }
    if (std::abs(plan.elevations[0] - plan.elevations[1]) < radiansFromDegrees(1)) {
        throw std::invalid_argument(
            "the two elevations of the plan are equal, so that nothing says how values change with "
            "elevation; choose them at least 1 degree apart, as 30,75");
    }
    for (const int count : {plan.axialCount, plan.diagonalCount}) {
        if (count < 1 || count > 360) {
            throw std::invalid_argument(
                fmt::format("{} samples in a slice are not possible: choose 1 to 360", count));
        }
    }
    if (!std::isfinite(plan.alpha)) throw std::invalid_argument("alpha is not a number of degrees");
}

}  // namespace abrdf
