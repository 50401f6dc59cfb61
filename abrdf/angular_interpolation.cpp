// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/angular_interpolation.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace abrdf {

namespace {

constexpr Radians kSameAngle = radiansFromDegrees(0.02);  // File names hold rounded degrees.

}  // namespace

void DirectionWeights::add(std::size_t index, double weight) {
    if (weight <= 0) return;
    for (std::size_t i = 0; i < count; ++i) {
        if (terms[i].index == index) {
            terms[i].weight += weight;
            return;
        }
    }
    terms[count++] = {index, weight};
}

AngularInterpolation::AngularInterpolation(std::vector<Direction> directions)
    : directions_(std::move(directions)) {
    std::vector<std::size_t> order(directions_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return directions_[i].theta; });
    for (const std::size_t i : order) {
        const Radians theta = directions_[i].theta;
        if (rings_.empty() || theta - rings_.back().theta > kSameAngle)
            rings_.push_back({theta, {}, {}});
        rings_.back().indices.push_back(i);
    }
    for (Ring& ring : rings_) {
        std::ranges::stable_sort(ring.indices, {},
                                 [&](std::size_t i) { return wrappedAzimuth(directions_[i].phi); });
        for (const std::size_t i : ring.indices) {
            ring.phis.push_back(wrappedAzimuth(directions_[i].phi));
        }
    }
    // Fewer than three directions a ring on average: a scattered list.
    if (rings_.size() > 1 && rings_.size() * 3 > directions_.size()) rings_.clear();
}

DirectionWeights AngularInterpolation::weights(Direction target) const {
    if (rings_.empty()) return nearestFour(target);
    DirectionWeights result;
    const auto above = std::ranges::find_if(
        rings_, [&](const Ring& ring) { return ring.theta >= target.theta - kSameAngle; });
    if (above == rings_.end()) {
        addRing(rings_.back(), target.phi, 1, result);
        result.extrapolated = true;
    } else if (above == rings_.begin() || above->theta - target.theta <= kSameAngle) {
        addRing(*above, target.phi, 1, result);
    } else {
        const Ring& below = *std::prev(above);
        const double t = (target.theta - below.theta) / (above->theta - below.theta);
        addRing(below, target.phi, 1 - t, result);
        addRing(*above, target.phi, t, result);
    }
    return result;
}

void AngularInterpolation::addRing(const Ring& ring, Radians phi, double weight,
                                   DirectionWeights& result) const {
    const std::size_t n = ring.indices.size();
    assert(n > 0);
    const Radians wanted = wrappedAzimuth(phi);
    // The last one at or before `wanted`, around the circle.
    const auto past = static_cast<std::size_t>(
        std::ranges::upper_bound(ring.phis, wanted + kSameAngle) - ring.phis.begin());
    const std::size_t k = (past + n - 1) % n;
    const std::size_t before = ring.indices[k];
    const std::size_t after = ring.indices[(k + 1) % n];
    const Radians toWanted =
        wrappedAzimuth(wanted - directions_[before].phi + kSameAngle) - kSameAngle;
    Radians gap = wrappedAzimuth(directions_[after].phi - directions_[before].phi);
    if (gap <= 0) gap = 2 * kPi;
    const double t = toWanted <= kSameAngle ? 0 : std::min(1.0, toWanted / gap);
    // A node within rounding is the node itself.
    const double snapped = gap - toWanted <= kSameAngle ? 1 : t;
    result.add(before, weight * (1 - snapped));
    result.add(after, weight * snapped);
}

DirectionWeights AngularInterpolation::nearestFour(Direction target) const {
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        nearest.emplace_back(angleBetween(directions_[i], target), i);
    }
    const std::size_t count = std::min<std::size_t>(4, nearest.size());
    std::ranges::partial_sort(nearest, nearest.begin() + static_cast<std::ptrdiff_t>(count));
    DirectionWeights result;
    if (nearest.front().first <= kSameAngle) {
        result.add(nearest.front().second, 1);
        return result;
    }
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += 1 / (nearest[i].first * nearest[i].first);
    for (std::size_t i = 0; i < count; ++i) {
        result.add(nearest[i].second, 1 / (nearest[i].first * nearest[i].first) / sum);
    }
    return result;
}

std::vector<WeightedPair> pairWeights(const AngularGrid& grid, const AngularInterpolation& lights,
                                      const AngularInterpolation& views,
                                      const LightAndView& target) {
    const DirectionWeights light = lights.weights(target.light);
    const DirectionWeights view = views.weights(target.view);
    std::vector<WeightedPair> result;
    for (std::size_t l = 0; l < light.count; ++l) {
        for (std::size_t v = 0; v < view.count; ++v) {
            result.push_back({grid.pairIndex(light.terms[l].index, view.terms[v].index),
                              static_cast<float>(light.terms[l].weight * view.terms[v].weight)});
        }
    }
    return result;
}

}  // namespace abrdf
