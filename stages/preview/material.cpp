// SPDX-License-Identifier: BSD-3-Clause
#include "stages/preview/material.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

namespace {

Radians lastThetaOf(const std::vector<Direction>& directions) {
    return std::ranges::max_element(directions, {}, &Direction::theta)->theta;
}

}  // namespace

Material::Material(const Atlas& atlas)
    : lights_(atlas.header().grid.lights()),
      views_(atlas.header().grid.views()),
      texelsWide_(atlas.header().layout.texelsWide),
      texelsHigh_(atlas.header().layout.texelsHigh),
      lightCount_(atlas.header().grid.lights().size()),
      viewCount_(atlas.header().grid.views().size()),
      lastTheta_(lastThetaOf(atlas.header().grid.lights())),
      cosineIsInside_(atlas.header().cosine == Cosine::kKept),
      lobe_(atlas),
      values_(atlas.pixels().size()) {
    for (const Direction& view : atlas.header().grid.views()) {
        for (const Direction& light : atlas.header().grid.lights()) {
            const Radians half = halfAngleOf(vectorFromDirection(light), vectorFromDirection(view));
            inverseLobes_.push_back(static_cast<float>(1 / lobe_.at(half)));
        }
    }
    forEachTexelBlock(atlas.header().layout.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        AtlasSample sample;
        sample.texelX = static_cast<int>(texel) % texelsWide_;
        sample.texelY = static_cast<int>(texel) / texelsWide_;
        Rgb* value = &values_[texel * viewCount_ * lightCount_];
        for (sample.view = 0; sample.view < static_cast<int>(viewCount_); ++sample.view) {
            for (sample.light = 0; sample.light < static_cast<int>(lightCount_); ++sample.light) {
                const Rgb stored = atlas.at(sample);
                *value++ = isFinite(stored) ? stored : Rgb{};
            }
        }
    });
}

double Material::lightFactor(Radians theta) const {
    const double cosine = std::cos(theta);
    if (cosine <= 0) return 0;
    if (!cosineIsInside_) return cosine;
    return theta > lastTheta_ ? cosine / std::cos(lastTheta_) : 1;
}

std::span<const float> Material::inverseLobe(std::size_t view) const {
    return std::span(inverseLobes_).subspan(view * lightCount_, lightCount_);
}

std::span<const Rgb> Material::row(int texelX, int texelY, std::size_t view) const {
    const auto texel = static_cast<std::size_t>(texelY) * static_cast<std::size_t>(texelsWide_) +
                       static_cast<std::size_t>(texelX);
    return std::span(values_).subspan((texel * viewCount_ + view) * lightCount_, lightCount_);
}

}  // namespace abrdf
