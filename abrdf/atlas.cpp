// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/atlas.h"

#include "abrdf/for_each_texel.h"

#include <fmt/format.h>

#include <array>
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

Atlas meanOverTexels(const Atlas& atlas) {
    AtlasHeader header = atlas.header();
    const AtlasLayout layout = header.layout;
    header.layout = {AtlasKind::kAngular, 1, 1, layout.lights, layout.views};
    std::vector<Rgb> means(header.grid.pairCount());
    forEachTexelBlock(means.size(), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t pair = begin; pair < end; ++pair) {
            std::array<double, 4> sum{};  // Red, green, blue, how many.
            for (std::size_t texel = 0; texel < layout.texelCount(); ++texel) {
                const auto wide = static_cast<std::size_t>(layout.texelsWide);
                const Rgb c =
                    atlas.at({static_cast<int>(texel % wide), static_cast<int>(texel / wide),
                              static_cast<int>(header.grid.lightOf(pair)),
                              static_cast<int>(header.grid.viewOf(pair))});
                if (!isFinite(c)) continue;
                sum[0] += static_cast<double>(c.r);
                sum[1] += static_cast<double>(c.g);
                sum[2] += static_cast<double>(c.b);
                sum[3] += 1;
            }
            means[pair] = {static_cast<float>(sum[0] / sum[3]), static_cast<float>(sum[1] / sum[3]),
                           static_cast<float>(sum[2] / sum[3])};
        }
    });
    return {std::move(header), std::move(means)};
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
