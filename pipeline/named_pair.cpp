// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/named_pair.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace abrdf {

LightAndView pairFrom(const std::string& text) {
    std::vector<double> degrees;
    const char* at = text.data();
    const char* end = at + text.size();
    while (at < end && degrees.size() < 5) {
        double value = 0;
        const auto [rest, error] = std::from_chars(at, end, value);
        if (error != std::errc()) break;
        degrees.push_back(value);
        at = rest < end && *rest == ',' ? rest + 1 : rest;
        if (rest == at && rest < end) break;
    }
    const bool valid = at == end && degrees.size() == 4 && degrees[0] >= 0 && degrees[0] <= 90 &&
                       degrees[2] >= 0 && degrees[2] <= 90;
    if (!valid) {
        throw std::invalid_argument(fmt::format(
            "the pair '{}' is not understood: write THETA_I,PHI_I,THETA_V,PHI_V in degrees, as "
            "30,90,15,0",
            text));
    }
    const auto direction = [&](std::size_t i) {
        return Direction{radiansFromDegrees(degrees[i]),
                         wrappedAzimuth(radiansFromDegrees(degrees[i + 1]))};
    };
    return {direction(0), direction(2)};
}

std::string pairName(const LightAndView& pair) {
    const auto key = [](Radians angle) {
        const double degrees = std::round(degreesFromRadians(angle) * 1e4) / 1e4;
        return degrees == std::round(degrees) ? fmt::format("{:03.0f}", degrees)
                                              : fmt::format("{}", degrees);
    };
    return fmt::format("tl{} pl{} tv{} pv{}", key(pair.light.theta), key(pair.light.phi),
                       key(pair.view.theta), key(pair.view.phi));
}

}  // namespace abrdf
