// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/reciprocity.h"

#include <cmath>
#include <optional>
#include <vector>

namespace abrdf {

namespace {

/// The index in `list` of each of `directions`, where it is there within 0.02 degrees.
std::vector<std::optional<std::size_t>> placesIn(const std::vector<Direction>& list,
                                                 const std::vector<Direction>& directions) {
    std::vector<std::optional<std::size_t>> places;
    for (const Direction& d : directions) {
        const std::size_t nearest = nearestDirection(list, d);
        const bool same = angleBetween(list[nearest], d) < radiansFromDegrees(0.02);
        places.push_back(same ? std::optional(nearest) : std::nullopt);
    }
    return places;
}

double sumOf(Rgb c) {
    return static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b);
}

}  // namespace

Reciprocity reciprocityOf(const AngularGrid& grid, std::span<const Rgb> values, Cosine cosine) {
    const auto viewOfLight = placesIn(grid.views(), grid.lights());
    const auto lightOfView = placesIn(grid.lights(), grid.views());
    Reciprocity result;
    double stored = 0;
    double divided = 0;
    for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
        const auto view = viewOfLight[grid.lightOf(pair)];
        const auto light = lightOfView[grid.viewOf(pair)];
        if (!view || !light) continue;
        const std::size_t swapped = grid.pairIndex(*light, *view);
        if (swapped <= pair) continue;
        const double a = sumOf(values[pair]);
        const double b = sumOf(values[swapped]);
        if (!(a > 0 && b > 0) || !std::isfinite(a) || !std::isfinite(b)) continue;
        const double cosA = std::cos(grid.pair(pair).light.theta);
        const double cosB = std::cos(grid.pair(swapped).light.theta);
        const double asStored = std::log(a / b);
        const double asDivided = std::log(a / cosA) - std::log(b / cosB);
        ++result.pairs;
        stored += asStored * asStored;
        divided += asDivided * asDivided;
        // 2 |f - g| / (f + g) = 2 tanh(|ln f - ln g| / 2)
        const double deviation =
            2 * std::tanh(std::abs(cosine == Cosine::kKept ? asDivided : asStored) / 2);
        if (deviation > result.largest) {
            result.largest = deviation;
            result.where = grid.pair(pair);
        }
    }
    if (result.pairs > 0) {
        result.rmsAsStored = std::sqrt(stored / static_cast<double>(result.pairs));
        result.rmsDivided = std::sqrt(divided / static_cast<double>(result.pairs));
    }
    return result;
}

Cosine cosineFromReciprocity(const Reciprocity& r, Cosine fallback) {
    constexpr std::size_t kFewest = 10;
    constexpr double kClear = 0.9;
    if (r.pairs < kFewest) return fallback;
    if (r.rmsDivided < kClear * r.rmsAsStored) return Cosine::kKept;
    if (r.rmsAsStored < kClear * r.rmsDivided) return Cosine::kAbsent;
    return fallback;
}

}  // namespace abrdf
