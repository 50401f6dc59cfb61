// SPDX-License-Identifier: BSD-3-Clause
#include "stages/slice/snap_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

namespace abrdf {

namespace {

constexpr Radians kRounding = 1e-6;

/// Directions within the bound.
std::vector<std::size_t> within(const std::vector<Direction>& directions, Direction wanted,
                                Radians bound) {
    std::vector<std::size_t> near;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (angleBetween(directions[i], wanted) <= bound + kRounding) near.push_back(i);
    }
    return near;
}

/// The nearest present pair whose directions are both within the bound.
std::optional<std::size_t> nearestPresent(const LightAndView& wanted, const AngularGrid& grid,
                                          std::span<const std::uint8_t> present, Radians bound) {
    std::optional<std::size_t> nearest;
    double least = 0;
    const std::vector<std::size_t> views = within(grid.views(), wanted.view, bound);
    for (const std::size_t light : within(grid.lights(), wanted.light, bound)) {
        for (const std::size_t view : views) {
            const std::size_t pair = grid.pairIndex(light, view);
            if (present[pair] == 0) continue;
            const double distance = squaredDistance(grid.pair(pair), wanted);
            if (nearest && distance >= least) continue;
            nearest = pair;
            least = distance;
        }
    }
    return nearest;
}

std::string sentenceOf(const LightAndView& wanted, Radians distance) {
    return fmt::format("theta_i {:.5g} phi_i {:.5g} theta_v {:.5g} phi_v {:.5g}, {:.1f} away",
                       degreesFromRadians(wanted.light.theta), degreesFromRadians(wanted.light.phi),
                       degreesFromRadians(wanted.view.theta), degreesFromRadians(wanted.view.phi),
                       degreesFromRadians(distance));
}

}  // namespace

SnappedPlan snapPlan(const SamplePlan& plan, const AngularGrid& grid,
                     std::span<const std::uint8_t> present, Radians bound) {
    const NearestDirection lights(grid.lights());
    const NearestDirection views(grid.views());
    SnappedPlan snapped{{plan.name, {}, plan.posterSlices}, 0};
    std::vector<std::string> far;
    for (const LightAndView& wanted : plan.samples) {
        std::size_t pair = grid.pairIndex(lights.indexOf(wanted.light), views.indexOf(wanted.view));
        const LightAndView nearest = grid.pair(pair);
        const Radians distance = std::max(angleBetween(nearest.light, wanted.light),
                                          angleBetween(nearest.view, wanted.view));
        if (distance > bound + kRounding) {
            far.push_back(sentenceOf(wanted, distance));
            continue;
        }
        if (!present.empty() && present[pair] == 0) {
            if (const auto other = nearestPresent(wanted, grid, present, bound)) {
                pair = *other;
                ++snapped.stoodIn;
            }
        }
        snapped.plan.samples.push_back(grid.pair(pair));
    }
    if (far.empty()) return snapped;
    const std::size_t count = far.size();
    far.resize(std::min<std::size_t>(5, count));
    throw std::runtime_error(fmt::format(
        "the plan {}: {} of its {} samples {} no measured pair within {:g} degrees ({}{}); choose "
        "a plan for these directions (abrdf plan --input), or a larger --snap",
        plan.name, count, plan.samples.size(), count == 1 ? "has" : "have",
        degreesFromRadians(bound), fmt::join(far, "; "), count > far.size() ? "; ..." : ""));
}

}  // namespace abrdf
