// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/angular_interpolation.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

namespace abrdf {

namespace {

constexpr Radians kSameAngle = radiansFromDegrees(0.02);  // File names hold rounded degrees.

/// Lagrange's weights of the nodes at x = target.
template <std::size_t N>
std::array<double, N> lagrangeWeights(const std::array<double, N>& nodes, double target) {
    std::array<double, N> weights{};
    for (std::size_t j = 0; j < N; ++j) {
        weights[j] = 1;
        for (std::size_t m = 0; m < N; ++m) {
            if (m != j) weights[j] *= (target - nodes[m]) / (nodes[j] - nodes[m]);
        }
    }
    return weights;
}

}  // namespace

void DirectionWeights::add(std::size_t index, double weight) {
    if (weight == 0) return;
    for (Term& term : terms) {
        if (term.index == index) {
            term.weight += weight;
            return;
        }
    }
    terms.push_back({index, weight});
}

AngularInterpolation::AngularInterpolation(std::vector<Direction> directions)
    : directions_(std::move(directions)) {
    std::vector<std::size_t> order(directions_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return directions_[i].theta; });
    for (const std::size_t i : order) {
        const Radians theta = directions_[i].theta;
        if (rings_.empty() || theta - rings_.back().theta > kSameAngle) {
            rings_.push_back({theta, {}, {}});
        }
        rings_.back().indices.push_back(i);
    }
    const auto azimuth = [&](std::size_t i) { return wrappedAzimuth(directions_[i].phi); };
    for (Ring& ring : rings_) {
        std::ranges::stable_sort(ring.indices, {}, azimuth);
        for (const std::size_t i : ring.indices) ring.azimuths.push_back(azimuth(i));
        const std::size_t n = ring.indices.size();
        const Radians step = 2 * kPi / static_cast<double>(n);
        for (std::size_t k = 0; k < n; ++k) {
            const Radians even = ring.azimuths[0] + static_cast<double>(k) * step;
            ring.isEven = ring.isEven && std::abs(ring.azimuths[k] - even) < 2 * kSameAngle;
        }
    }
    // Fewer than three directions a ring on average: a scattered list.
    if (rings_.size() > 1 && rings_.size() * 3 > directions_.size()) rings_.clear();
}

std::vector<Radians> AngularInterpolation::ringThetas() const {
    std::vector<Radians> thetas;
    for (const Ring& ring : rings_) thetas.push_back(ring.theta);
    return thetas;
}

bool AngularInterpolation::isNearerPole(Radians theta) const {
    return rings_.size() > 1 && theta < rings_.front().theta - kSameAngle;
}

RingCell AngularInterpolation::cellOf(Radians theta) const {
    const auto above = std::ranges::find_if(
        rings_, [&](const Ring& ring) { return ring.theta >= theta - kSameAngle; });
    const auto place = static_cast<std::size_t>(above - rings_.begin());
    if (above == rings_.end()) return {place - 1, place - 1, 0, true};
    if (place == 0 || above->theta - theta <= kSameAngle) return {place, place, 0, false};
    const Radians below = rings_[place - 1].theta;
    return {place - 1, place, (theta - below) / (above->theta - below), false};
}

RingWeights AngularInterpolation::onRing(std::size_t ring, Radians phi) const {
    return linearOn(rings_[ring], phi);
}

DirectionWeights AngularInterpolation::weights(Direction target) const {
    if (rings_.empty()) return nearestEight(target);
    DirectionWeights result;
    result.terms.reserve(4);
    if (isNearerPole(target.theta)) {
        const Ring& first = rings_.front();
        const double share = std::max(0.0, target.theta / first.theta);
        addLinear(first, target.phi, share, result);
        const double each = (1 - share) / static_cast<double>(first.indices.size());
        for (const std::size_t i : first.indices) result.add(i, each);
        return result;
    }
    const RingCell cell = cellOf(target.theta);
    result.extrapolated = cell.extrapolated;
    addLinear(rings_[cell.below], target.phi, 1 - cell.share, result);
    addLinear(rings_[cell.above], target.phi, cell.share, result);
    return result;
}

DirectionWeights AngularInterpolation::smoothWeights(Direction target) const {
    constexpr std::size_t kNodes = 4;
    const bool hasPole = !rings_.empty() && rings_.front().theta <= kSameAngle;
    if (!hasPole || rings_.size() < kNodes) return weights(target);
    DirectionWeights result;
    result.terms.reserve(kNodes * kNodes);
    const RingCell cell = cellOf(target.theta);
    result.extrapolated = cell.extrapolated;
    if (cell.below == cell.above) {
        addCubic(rings_[cell.below], target.phi, 1, result);
        return result;
    }
    // Four rings around the target; past the pole they go on at negative theta, on the other side.
    const auto last = static_cast<std::ptrdiff_t>(rings_.size()) - 1;
    const auto first = std::min(static_cast<std::ptrdiff_t>(cell.below) - 1, last - 3);
    std::array<double, kNodes> thetas{};
    for (std::size_t j = 0; j < kNodes; ++j) {
        const std::ptrdiff_t ring = first + static_cast<std::ptrdiff_t>(j);
        const Radians theta = rings_[static_cast<std::size_t>(std::abs(ring))].theta;
        thetas[j] = ring < 0 ? -theta : theta;
    }
    const auto shares = lagrangeWeights(thetas, target.theta);
    for (std::size_t j = 0; j < kNodes; ++j) {
        const std::ptrdiff_t ring = first + static_cast<std::ptrdiff_t>(j);
        addCubic(rings_[static_cast<std::size_t>(std::abs(ring))],
                 ring < 0 ? target.phi + kPi : target.phi, shares[j], result);
    }
    return result;
}

AngularInterpolation::AzimuthPlace AngularInterpolation::placeOn(const Ring& ring, Radians phi) {
    const std::size_t n = ring.indices.size();
    assert(n > 0);
    const Radians wanted = wrappedAzimuth(phi);
    const auto after = std::ranges::upper_bound(ring.azimuths, wanted + kSameAngle);
    const std::size_t before = after == ring.azimuths.begin()
                                   ? n - 1
                                   : static_cast<std::size_t>(after - ring.azimuths.begin()) - 1;
    Radians gap = wrappedAzimuth(ring.azimuths[(before + 1) % n] - ring.azimuths[before]);
    if (gap <= 0) gap = 2 * kPi;
    const Radians past = wrappedAzimuth(wanted - ring.azimuths[before] + kSameAngle) - kSameAngle;
    // A node within rounding is the node itself.
    if (past <= kSameAngle) return {before, gap, 0};
    if (gap - past <= kSameAngle) return {(before + 1) % n, gap, 0};
    return {before, gap, past};
}

RingWeights AngularInterpolation::linearOn(const Ring& ring, Radians phi) {
    const AzimuthPlace place = placeOn(ring, phi);
    const double share = std::min(1.0, place.past / place.gap);
    const std::size_t before = ring.indices[place.before];
    const std::size_t after = ring.indices[(place.before + 1) % ring.indices.size()];
    if (share == 0 || before == after) return {{{{before, 1}, {}}}, 1};
    return {{{{before, 1 - share}, {after, share}}}, 2};
}

void AngularInterpolation::addLinear(const Ring& ring, Radians phi, double weight,
                                     DirectionWeights& result) {
    const RingWeights along = linearOn(ring, phi);
    for (std::size_t i = 0; i < along.count; ++i) {
        result.add(along.terms[i].index, weight * along.terms[i].weight);
    }
}

void AngularInterpolation::addCubic(const Ring& ring, Radians phi, double weight,
                                    DirectionWeights& result) {
    const std::size_t n = ring.indices.size();
    const AzimuthPlace place = placeOn(ring, phi);
    // On fewer than six azimuths, or uneven ones, a cubic says nothing.
    if (place.past == 0 || n < 6 || !ring.isEven) {
        addLinear(ring, phi, weight, result);
        return;
    }
    // Lagrange's weights of the nodes -1, 0, 1, 2 at t.
    const double t = place.past / place.gap;
    const std::array<double, 4> shares = {-t * (t - 1) * (t - 2) / 6,
                                          (t + 1) * (t - 1) * (t - 2) / 2,
                                          -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
    for (std::size_t j = 0; j < 4; ++j) {
        result.add(ring.indices[(place.before + n + j - 1) % n], weight * shares[j]);
    }
}

DirectionWeights AngularInterpolation::nearestEight(Direction target) const {
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        nearest.emplace_back(angleBetween(directions_[i], target), i);
    }
    const std::size_t count = std::min<std::size_t>(9, nearest.size());
    std::ranges::partial_sort(nearest, nearest.begin() + static_cast<std::ptrdiff_t>(count));
    DirectionWeights result;
    if (nearest.front().first <= kSameAngle) {
        result.add(nearest.front().second, 1);
        return result;
    }
    // ((R - d) / (R d))^2 with R the distance of the ninth: it comes and goes with weight 0.
    const bool all = nearest.size() < 9;
    const double end = all ? 2 * nearest[count - 1].first : nearest[count - 1].first;
    const auto weightAt = [&](double d) {
        const double w = std::max(0.0, end - d) / (end * d);
        return w * w;
    };
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += weightAt(nearest[i].first);
    if (sum <= 0) {  // All as far away as the ninth.
        for (std::size_t i = 0; i < count; ++i) {
            result.add(nearest[i].second, 1.0 / static_cast<double>(count));
        }
        return result;
    }
    for (std::size_t i = 0; i < count; ++i) {
        result.add(nearest[i].second, weightAt(nearest[i].first) / sum);
    }
    return result;
}

}  // namespace abrdf
