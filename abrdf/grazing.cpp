// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/grazing.h"

#include "abrdf/for_each_texel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace abrdf {

namespace {

constexpr Radians kStep = radiansFromDegrees(15);        ///< The databases' last two elevations.
constexpr Radians kRounding = radiansFromDegrees(0.01);  ///< Of stored angles.

/// 1 at the last measured elevation, 0 at the horizon, level at both.
double fadeAt(Radians theta, Radians maxTheta) {
    const double s = std::clamp((kPi / 2 - theta) / (kPi / 2 - maxTheta), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

}  // namespace

std::string nameOf(Grazing grazing) {
    switch (grazing) {
        case Grazing::kFade:
            return "fade";
        case Grazing::kExtrapolate:
            return "extrapolate";
        default:
            return "hold";
    }
}

Grazing grazingFromName(const std::string& name) {
    for (const auto grazing : {Grazing::kHold, Grazing::kFade, Grazing::kExtrapolate}) {
        if (nameOf(grazing) == name) return grazing;
    }
    throw std::invalid_argument(fmt::format(
        "'{}' is no way past the measured elevations: use hold, fade or extrapolate", name));
}

std::vector<GrazingTerm> grazingTerms(Direction d, Radians maxTheta, Grazing policy,
                                      bool hasCosine) {
    if (d.theta <= maxTheta + kRounding) return {{d, 1}};
    const auto at = [&](Radians theta, double weight) {
        const double cosine = hasCosine ? std::cos(d.theta) / std::cos(theta) : 1;
        return GrazingTerm{{theta, d.phi}, weight * cosine};
    };
    if (policy == Grazing::kExtrapolate && maxTheta > kStep) {
        const double past = (d.theta - maxTheta) / kStep;
        return {at(maxTheta, 1 + past), at(maxTheta - kStep, -past)};
    }
    return {at(maxTheta, policy == Grazing::kFade ? fadeAt(d.theta, maxTheta) : 1)};
}

GrazingMap::GrazingMap(const AngularGrid& outer, Radians maxMeasuredTheta, Grazing policy,
                       Cosine cosine) {
    const auto isPast = [&](const Direction& d) { return d.theta > maxMeasuredTheta + kRounding; };
    const auto lightsPast =
        static_cast<std::uint64_t>(std::ranges::count_if(outer.lights(), isPast));
    const auto viewsPast = static_cast<std::uint64_t>(std::ranges::count_if(outer.views(), isPast));
    extrapolatedPairs_ = outer.pairCount() -
                         (outer.lights().size() - lightsPast) * (outer.views().size() - viewsPast);
    if (isIdentity()) {
        inner_ = outer;
        return;
    }
    std::vector<Direction> lights;
    std::vector<Direction> views;
    const bool hasCosine = cosine == Cosine::kKept;
    lights_ = split(outer.lights(), maxMeasuredTheta, policy, hasCosine, lights);
    views_ = split(outer.views(), maxMeasuredTheta, policy, false, views);
    inner_ = AngularGrid(std::move(lights), std::move(views));
}

std::vector<GrazingMap::Terms> GrazingMap::split(const std::vector<Direction>& outer,
                                                 Radians maxTheta, Grazing policy, bool hasCosine,
                                                 std::vector<Direction>& inner) {
    std::map<std::pair<Radians, Radians>, std::size_t> indexOf;
    std::vector<Terms> all;
    for (const Direction& d : outer) {
        Terms terms;
        for (const GrazingTerm& term : grazingTerms(d, maxTheta, policy, hasCosine)) {
            const auto [place, isNew] =
                indexOf.try_emplace({term.direction.theta, term.direction.phi}, inner.size());
            if (isNew) inner.push_back(term.direction);
            terms.push_back({place->second, static_cast<float>(term.weight)});
        }
        all.push_back(std::move(terms));
    }
    return all;
}

Rgb GrazingMap::value(std::span<const Rgb> inner, const Terms& light, const Terms& view) const {
    const auto at = [&](const Term& l, const Term& v) {
        return inner[inner_.pairIndex(l.index, v.index)];
    };
    if (light.size() == 1 && view.size() == 1) {
        return (light[0].weight * view[0].weight) * at(light[0], view[0]);
    }
    Rgb sum;
    for (const Term& l : light) {
        for (const Term& v : view) sum += (l.weight * v.weight) * at(l, v);
    }
    return {std::max(0.0F, sum.r), std::max(0.0F, sum.g), std::max(0.0F, sum.b)};
}

std::vector<double> GrazingMap::innerWeights(std::span<const double> weights) const {
    if (isIdentity()) return {weights.begin(), weights.end()};
    std::vector<double> inner(inner_.pairCount());
    std::size_t pair = 0;
    for (const Terms& light : lights_) {
        for (const Terms& view : views_) {
            const double weight = weights[pair++];
            for (const Term& l : light) {
                for (const Term& v : view) {
                    inner[inner_.pairIndex(l.index, v.index)] +=
                        weight * static_cast<double>(std::abs(l.weight * v.weight));
                }
            }
        }
    }
    return inner;
}

AbrdfTile GrazingMap::apply(const AbrdfTile& inner) const {
    if (isIdentity()) return inner;
    AbrdfTile outer(inner.texelCount(), lights_.size() * views_.size());
    forEachTexelBlock(inner.texelCount(), 1,
                      [&](std::size_t texel, std::size_t) { apply(inner[texel], outer[texel]); });
    return outer;
}

void GrazingMap::apply(std::span<const Rgb> inner, std::span<Rgb> outer) const {
    std::size_t pair = 0;
    for (const Terms& light : lights_) {
        for (const Terms& view : views_) outer[pair++] = value(inner, light, view);
    }
}

}  // namespace abrdf
