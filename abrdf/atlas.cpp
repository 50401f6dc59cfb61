// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

Atlas::Atlas(AtlasHeader header, std::vector<Rgb> pixels)
    : header_(std::move(header)), pixels_(std::move(pixels)), interpolation_(header_.grid) {
    if (pixels_.size() != header_.layout.texelCount() * header_.grid.pairCount()) {
        throw std::invalid_argument("an atlas needs as many pixels as its header says");
    }
}

Rgb Atlas::at(const AtlasSample& sample) const {
    const AtlasPixel pixel = header_.layout.pixelFromSample(sample);
    return pixels_[static_cast<std::size_t>(pixel.y) *
                       static_cast<std::size_t>(header_.layout.width()) +
                   static_cast<std::size_t>(pixel.x)];
}

std::vector<WeightedPair> Atlas::weights(Direction light, Direction view) const {
    return interpolation_.weights({light, view});
}

Rgb lookUp(const Atlas& atlas, Direction light, Direction view, int texelX, int texelY) {
    const AtlasLayout& layout = atlas.header().layout;
    if (texelX < 0 || texelY < 0 || texelX >= layout.texelsWide || texelY >= layout.texelsHigh) {
        throw std::out_of_range(fmt::format("texel {},{} is not in an atlas of {} x {} texels",
                                            texelX, texelY, layout.texelsWide, layout.texelsHigh));
    }
    const AngularGrid& grid = atlas.header().grid;
    Rgb sum;
    for (const WeightedPair& term : atlas.weights(light, view)) {
        sum += term.weight * atlas.at({texelX, texelY, static_cast<int>(grid.lightOf(term.pair)),
                                       static_cast<int>(grid.viewOf(term.pair))});
    }
    return sum;
}

}  // namespace abrdf
