// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/gathered_light.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

/// Calls add(light direction, strength) for each share of a light, visible() of which is seen.
template <typename Visible, typename Add>
void share(const Material& material, const Frame& frame, const Light& light,
           const Visible& visibleShare, const Add& add) {
    const Imath::V3d local = frame.local(light.direction);
    if (local.z <= 0) return;
    const double visible = visibleShare();
    if (visible <= 0) return;
    const Direction direction = directionFromVector(local);
    const double factor = visible * material.lightFactor(direction.theta);
    const DirectionWeights weights = material.lights(direction);
    for (const auto& term : weights.terms) {
        add(term.index, static_cast<float>(factor * term.weight) * light.strength);
    }
}

}  // namespace

void addShares(const Material& material, const Frame& frame, const Light& light, double factor,
               std::vector<LightShare>& shares) {
    share(
        material, frame, light, [&] { return factor; },
        [&](std::size_t index, Rgb strength) {
            shares.push_back({index, strength});
        });
}

GatheredLight::GatheredLight(const Material& material, const Surface& surface,
                             const std::vector<Light>& lights, const CameraOptions& camera)
    : lightCount_(material.lightCount()),
      wide_(surface.nodesWide()),
      high_(surface.nodesHigh()),
      closes_(surface.closesInU()),
      strengths_(static_cast<std::size_t>(wide_) * static_cast<std::size_t>(high_) * lightCount_) {
    const auto columns = static_cast<std::size_t>(wide_);
    const Imath::V3d towards = vectorFromAzimuthElevation(camera.azimuth, camera.elevation);
    // A ray differs from the camera's axis by half the field of view, a point's normal from its
    // nodes' by some degrees.
    const double turnedAway = -std::sin(std::min(kPi / 2, camera.fieldOfView / 2 * 1.5)) - 0.2;
    forEachTexelBlock(
        columns * static_cast<std::size_t>(high_), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t node = begin; node < end; ++node) {
                const int last = closes_ ? wide_ : wide_ - 1;
                const double u = last > 0 ? static_cast<double>(node % columns) / last : 0.5;
                const std::size_t row = node / columns;
                const double v = high_ > 1 ? static_cast<double>(row) / (high_ - 1) : 0.5;
                const Frame frame = surface.frameAt(u, v);
                if ((frame.normal ^ towards) < turnedAway) continue;
                Rgb* strengths = &strengths_[node * lightCount_];
                for (const Light& light : lights) {
                    share(
                        material, frame, light,
                        [&] { return surface.skyReaching(u, v, light.direction); },
                        [&](std::size_t index, Rgb strength) { strengths[index] += strength; });
                }
            }
        });
}

GatheredLight::Place GatheredLight::placeOf(double x, int nodes, bool closes) {
    if (nodes == 1) return {0, 0, 0};
    const double place = x * (closes ? nodes : nodes - 1);
    const auto before = std::min(static_cast<std::size_t>(place),
                                 static_cast<std::size_t>(closes ? nodes - 1 : nodes - 2));
    const std::size_t after = closes ? (before + 1) % static_cast<std::size_t>(nodes) : before + 1;
    return {before, after, static_cast<float>(place - static_cast<double>(before))};
}

void GatheredLight::at(double u, double v, std::span<Rgb> strengths) const {
    const Place x = placeOf(u, wide_, closes_);
    const Place y = placeOf(v, high_, false);
    const auto node = [&](std::size_t column, std::size_t row) {
        return &strengths_[(row * static_cast<std::size_t>(wide_) + column) * lightCount_];
    };
    const Rgb* a = node(x.before, y.before);
    const Rgb* b = node(x.after, y.before);
    const Rgb* c = node(x.before, y.after);
    const Rgb* d = node(x.after, y.after);
    const float wa = (1 - x.t) * (1 - y.t);
    const float wb = x.t * (1 - y.t);
    const float wc = (1 - x.t) * y.t;
    const float wd = x.t * y.t;
    for (std::size_t i = 0; i < lightCount_; ++i) {
        strengths[i] = wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i];
    }
}

}  // namespace abrdf
