// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/pair_interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace abrdf {

namespace {

// Relative differences of the two estimates up to which the smooth one counts alone, and from which
// on the linear one does.
constexpr double kAgree = 0.1;
constexpr double kDisagree = 0.3;

/// A colour summed in double.
struct Sum {
    double r = 0;
    double g = 0;
    double b = 0;

    void add(Rgb c, double weight) {
        r += weight * static_cast<double>(c.r);
        g += weight * static_cast<double>(c.g);
        b += weight * static_cast<double>(c.b);
    }
    double total() const { return r + g + b; }
};

/// Share of the linear estimate, 0 .. 1, without a kink.
double linearShare(const Sum& linear, const Sum& smooth) {
    const double size = std::max(std::abs(linear.total()), 1e-30);
    const double difference = std::abs(smooth.total() - linear.total()) / size;
    const double t = std::clamp((difference - kAgree) / (kDisagree - kAgree), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A corner of a cell of (theta_i, theta_v) and its weight.
struct Corner {
    std::size_t light = 0;
    std::size_t view = 0;
    double weight = 0;
};

std::array<Corner, 4> cornersOf(const RingCell& light, const RingCell& view, bool alongDiagonal) {
    const double x = light.share;
    const double y = view.share;
    if (!alongDiagonal) {
        return {{{light.below, view.below, (1 - x) * (1 - y)},
                 {light.above, view.below, x * (1 - y)},
                 {light.below, view.above, (1 - x) * y},
                 {light.above, view.above, x * y}}};
    }
    return {{{light.below, view.below, 1 - std::max(x, y)},
             {light.above, view.below, std::max(0.0, x - y)},
             {light.below, view.above, std::max(0.0, y - x)},
             {light.above, view.above, std::min(x, y)}}};
}

bool areEqual(const std::vector<Radians>& a, const std::vector<Radians>& b) {
    constexpr Radians kSame = radiansFromDegrees(0.05);
    return std::ranges::equal(a, b, [](Radians x, Radians y) { return std::abs(x - y) < kSame; });
}

}  // namespace

PairInterpolation::PairInterpolation(const AngularGrid& grid)
    : viewCount_(grid.views().size()),
      lights_(grid.lights()),
      views_(grid.views()),
      sameRings_(areEqual(lights_.ringThetas(), views_.ringThetas())) {}

PairInterpolation::Place PairInterpolation::placeIn(const AngularInterpolation& list,
                                                    Direction direction) {
    return {direction, list.weights(direction), list.smoothWeights(direction)};
}

template <typename Add>
void PairInterpolation::addTurned(std::size_t lightRing, std::size_t viewRing,
                                  const LightAndView& target, double weight, const Add& add) const {
    if (weight <= 0) return;
    // The finer ring leads: the other direction is turned by half its step at most.
    const bool lightLeads = lights_.ringSize(lightRing) >= views_.ringSize(viewRing);
    const AngularInterpolation& leading = lightLeads ? lights_ : views_;
    const AngularInterpolation& following = lightLeads ? views_ : lights_;
    const Direction& leader = lightLeads ? target.light : target.view;
    const Direction& follower = lightLeads ? target.view : target.light;
    const std::size_t leadingRing = lightLeads ? lightRing : viewRing;
    const RingWeights leaders = leading.onRing(leadingRing, leader.phi);
    for (std::size_t i = 0; i < leaders.count; ++i) {
        const auto& lead = leaders.terms[i];
        // One direction stands for all azimuths, or is the wanted one: nothing to turn.
        const Radians turn =
            leaders.count == 1 ? 0 : leading.directions()[lead.index].phi - leader.phi;
        const RingWeights followers =
            following.onRing(lightLeads ? viewRing : lightRing, follower.phi + turn);
        for (std::size_t j = 0; j < followers.count; ++j) {
            const auto& follow = followers.terms[j];
            const std::size_t light = lightLeads ? lead.index : follow.index;
            const std::size_t view = lightLeads ? follow.index : lead.index;
            add(light * viewCount_ + view, weight * lead.weight * follow.weight);
        }
    }
}

template <typename Add>
void PairInterpolation::forEachLinearTerm(const Place& light, const Place& view,
                                          const Add& add) const {
    const bool onRings = lights_.hasRings() && views_.hasRings() &&
                         !lights_.isNearerPole(light.direction.theta) &&
                         !views_.isNearerPole(view.direction.theta);
    if (!onRings) {
        for (const auto& l : light.linear.terms) {
            for (const auto& v : view.linear.terms) {
                add(l.index * viewCount_ + v.index, l.weight * v.weight);
            }
        }
        return;
    }
    const RingCell lightCell = lights_.cellOf(light.direction.theta);
    const RingCell viewCell = views_.cellOf(view.direction.theta);
    for (const Corner& corner : cornersOf(lightCell, viewCell, sameRings_)) {
        addTurned(corner.light, corner.view, {light.direction, view.direction}, corner.weight, add);
    }
}

std::vector<WeightedPair> PairInterpolation::weights(const LightAndView& target) const {
    std::vector<WeightedPair> result;
    forEachLinearTerm(lightPlace(target.light), viewPlace(target.view),
                      [&](std::size_t pair, double weight) {
                          const auto share = static_cast<float>(weight);
                          if (share <= 0) return;
                          const auto same = std::ranges::find(result, pair, &WeightedPair::pair);
                          if (same == result.end()) {
                              result.push_back({pair, share});
                          } else {
                              same->weight += share;
                          }
                      });
    return result;
}

std::vector<std::size_t> PairInterpolation::pairsFor(const AngularGrid& targets) const {
    std::vector<Place> views;
    for (const Direction& d : targets.views()) views.push_back(viewPlace(d));
    std::vector<bool> isUsed(viewCount_ * lights_.directions().size());
    for (const Direction& d : targets.lights()) {
        const Place light = lightPlace(d);
        for (const Place& view : views) {
            forEachLinearTerm(light, view, [&](std::size_t pair, double) { isUsed[pair] = true; });
            if (isNode(light, view)) continue;
            for (const auto& l : light.smooth.terms) {
                for (const auto& v : view.smooth.terms) {
                    isUsed[l.index * viewCount_ + v.index] = true;
                }
            }
        }
    }
    std::vector<std::size_t> used;
    for (std::size_t pair = 0; pair < isUsed.size(); ++pair) {
        if (isUsed[pair]) used.push_back(pair);
    }
    return used;
}

Rgb PairInterpolation::value(const Place& light, const Place& view,
                             std::span<const Rgb> values) const {
    if (isNode(light, view)) {
        return values[light.linear.terms[0].index * viewCount_ + view.linear.terms[0].index];
    }
    Sum linear;
    forEachLinearTerm(light, view,
                      [&](std::size_t pair, double weight) { linear.add(values[pair], weight); });
    Sum smooth;
    for (const auto& l : light.smooth.terms) {
        Sum row;
        for (const auto& v : view.smooth.terms) {
            row.add(values[l.index * viewCount_ + v.index], v.weight);
        }
        smooth.r += l.weight * row.r;
        smooth.g += l.weight * row.g;
        smooth.b += l.weight * row.b;
    }
    const double share = linearShare(linear, smooth);
    const auto mixed = [&](double a, double b) {
        return static_cast<float>(share * a + (1 - share) * b);
    };
    return {mixed(linear.r, smooth.r), mixed(linear.g, smooth.g), mixed(linear.b, smooth.b)};
}

}  // namespace abrdf
