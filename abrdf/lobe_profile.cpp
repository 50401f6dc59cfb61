// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/lobe_profile.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

constexpr double kOffset = 2;  // Degrees.

/// The place of a half angle among the logarithms, 0 .. kPlaces - 1.
double placeOf(Radians halfAngle) {
    const double first = std::log(kOffset);
    const double last = std::log(90 + kOffset);
    const double degrees = std::clamp(degreesFromRadians(halfAngle), 0.0, 90.0);
    return (std::log(degrees + kOffset) - first) / (last - first) * (LobeProfile::kPlaces - 1);
}

struct Mean {
    double sum = 0;
    double weight = 0;
};

/// tan^2 of the half angle at a place.
double squaredTangent(std::size_t place) {
    const double first = std::log(kOffset);
    const double last = std::log(90 + kOffset);
    const double t = static_cast<double>(place) / (LobeProfile::kPlaces - 1);
    const double degrees = std::exp(first + t * (last - first)) - kOffset;
    return std::pow(std::tan(radiansFromDegrees(std::min(degrees, 89.0))), 2);
}

/// Places from..to have no pair of their own. The tip, from the mirror position on, is taken for
/// GGX's (1 + k tan^2)^-2 through both ends; the rest for lines.
void fillGap(std::array<double, LobeProfile::kPlaces>& values, std::size_t from, std::size_t to) {
    const double k = (std::exp((values[from] - values[to]) / 2) - 1) / squaredTangent(to);
    for (std::size_t i = from + 1; i < to; ++i) {
        const double t = static_cast<double>(i - from) / static_cast<double>(to - from);
        values[i] = from == 0 && k > 0 ? values[0] - 2 * std::log(1 + k * squaredTangent(i))
                                       : (1 - t) * values[from] + t * values[to];
    }
}

/// The means, with values wherever no pair is.
void fill(const std::array<Mean, LobeProfile::kPlaces>& means,
          std::array<double, LobeProfile::kPlaces>& values) {
    std::size_t before = LobeProfile::kPlaces;  // None yet.
    for (std::size_t i = 0; i < means.size(); ++i) {
        if (means[i].weight <= 0) continue;
        values[i] = means[i].sum / means[i].weight;
        if (before < i) fillGap(values, before, i);
        if (before > i) std::fill_n(values.begin(), i, values[i]);
        before = i;
    }
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(before) + 1, values.end(),
              values[before]);
}

}  // namespace

Radians halfAngleOf(const Imath::V3d& light, const Imath::V3d& view) {
    const Imath::V3d half = light + view;
    return std::atan2(std::hypot(half.x, half.y), half.z);
}

LobeProfile::LobeProfile(const Atlas& atlas) {
    const Atlas mean =
        atlas.header().layout.texelCount() > 1 ? meanOverTexels(atlas) : Atlas(atlas);
    const AngularGrid& grid = mean.header().grid;
    std::vector<double> greys(grid.pairCount());
    double most = 0;
    for (std::size_t i = 0; i < greys.size(); ++i) {
        const Rgb c =
            mean.at({0, 0, static_cast<int>(grid.lightOf(i)), static_cast<int>(grid.viewOf(i))});
        const double cosine =
            mean.header().cosine == Cosine::kKept ? std::cos(grid.pair(i).light.theta) : 1.0;
        const double grey = static_cast<double>(c.r + c.g + c.b) / (3 * cosine);
        greys[i] = std::isfinite(grey) ? std::max(grey, 0.0) : 0;
        most = std::max(most, greys[i]);
    }
    if (!(most > 0)) return;
    std::array<Mean, kPlaces> means{};
    for (std::size_t i = 0; i < greys.size(); ++i) {
        const LightAndView pair = grid.pair(i);
        const double place =
            placeOf(halfAngleOf(vectorFromDirection(pair.light), vectorFromDirection(pair.view)));
        Mean& nearest = means[static_cast<std::size_t>(std::lround(place))];
        nearest.sum += std::log(greys[i] + 1e-4 * most);
        nearest.weight += 1;
    }
    fill(means, logarithms_);
    const double top = logarithms_[0];
    for (std::size_t i = 0; i < kPlaces; ++i) {
        logarithms_[i] -= top;
        logarithms_[i] = std::min(logarithms_[i], i > 0 ? logarithms_[i - 1] : 0.0);
    }
    // Where nothing falls by more than half in 15 degrees, linear interpolation does as well and
    // leaves no trace of the profile.
    const double drop = -logarithms_[static_cast<std::size_t>(placeOf(radiansFromDegrees(15)))];
    const double strength =
        std::clamp((drop - std::log(2.0)) / (std::log(4.0) - std::log(2.0)), 0.0, 1.0);
    for (double& logarithm : logarithms_) logarithm *= strength;
}

double LobeProfile::at(Radians halfAngle) const {
    const double place = placeOf(halfAngle);
    const auto before = std::min(static_cast<std::size_t>(place), kPlaces - 2);
    const double t = place - static_cast<double>(before);
    const double u = 1 - t;
    const auto& c = logarithms_;
    const double sum = u * u * u * c[before > 0 ? before - 1 : 1] +
                       (3 * t * t * t - 6 * t * t + 4) * c[before] +
                       (3 * u * u * u - 6 * u * u + 4) * c[before + 1] +
                       t * t * t * c[std::min(before + 2, kPlaces - 1)];
    return std::exp(sum / 6);
}

}  // namespace abrdf
