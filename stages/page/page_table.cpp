// SPDX-License-Identifier: BSD-3-Clause
#include "stages/page/page_table.h"

#include "abrdf/lobe_profile.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace abrdf {

namespace {

constexpr Radians kSameTheta = radiansFromDegrees(0.02);
constexpr Radians kEven = radiansFromDegrees(0.1);
constexpr std::size_t kMostRings = 16;  // As many as the shader has places for.

std::uint16_t halfBits(float value) {
    constexpr float kLargest = 65504;
    return half(std::isfinite(value) ? std::clamp(value, -kLargest, kLargest) : 0).bits();
}

/// Is the ring from order[ring.first] evenly spread?
bool isEven(const PageRing& ring, const std::vector<std::size_t>& order,
            const std::vector<Direction>& directions) {
    const double step = 2 * kPi / ring.count;
    for (int k = 0; k < ring.count; ++k) {
        const Radians phi = directions[order[static_cast<std::size_t>(ring.first + k)]].phi;
        const double off = wrappedAzimuth(phi - ring.phi0 - k * step + kPi) - kPi;
        if (std::abs(off) > kEven) return false;
    }
    return true;
}

}  // namespace

std::optional<EvenRings> evenRings(const std::vector<Direction>& directions) {
    EvenRings result;
    result.order.resize(directions.size());
    std::iota(result.order.begin(), result.order.end(), std::size_t{0});
    std::ranges::stable_sort(result.order, {}, [&](std::size_t i) { return directions[i].theta; });
    for (std::size_t i = 0; i < result.order.size(); ++i) {
        const Radians theta = directions[result.order[i]].theta;
        if (result.rings.empty() || theta - result.rings.back().theta > kSameTheta) {
            result.rings.push_back({theta, 0, 0, static_cast<int>(i)});
        }
        ++result.rings.back().count;
    }
    if (result.rings.size() > kMostRings) return std::nullopt;
    for (PageRing& ring : result.rings) {
        const auto begin = result.order.begin() + ring.first;
        std::stable_sort(begin, begin + ring.count, [&](std::size_t a, std::size_t b) {
            return wrappedAzimuth(directions[a].phi) < wrappedAzimuth(directions[b].phi);
        });
        ring.phi0 = wrappedAzimuth(directions[*begin].phi);
        // At the pole azimuths mean nothing.
        if (ring.theta > kSameTheta && !isEven(ring, result.order, directions)) return std::nullopt;
    }
    return result;
}

PageTable pageTableOf(const Atlas& atlas) {
    const AngularGrid& own = atlas.header().grid;
    auto lights = evenRings(own.lights());
    auto views = evenRings(own.views());
    PageTable table;
    table.cosineInside = atlas.header().cosine == Cosine::kKept;
    table.resampled = !lights || !views;
    const LobeProfile lobe(atlas);
    table.lobe.assign(lobe.logarithms().begin(), lobe.logarithms().end());
    const AngularGrid grid = table.resampled ? AngularGrid(regularDirections(11, 48)) : own;
    if (table.resampled) lights = views = evenRings(grid.lights());
    table.lightRings = lights->rings;
    table.viewRings = views->rings;
    table.lights = static_cast<int>(grid.lights().size());
    table.views = static_cast<int>(grid.views().size());
    table.halves.reserve(3 * grid.pairCount());
    for (const std::size_t light : lights->order) {
        for (const std::size_t view : views->order) {
            const Rgb c = table.resampled
                              ? lookUp(atlas, grid.lights()[light], grid.views()[view], 0, 0)
                              : atlas.at({0, 0, static_cast<int>(light), static_cast<int>(view)});
            for (const float channel : {c.r, c.g, c.b}) table.halves.push_back(halfBits(channel));
        }
    }
    return table;
}

}  // namespace abrdf
