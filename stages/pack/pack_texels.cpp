// SPDX-License-Identifier: BSD-3-Clause
#include "stages/pack/pack_texels.h"

#include "abrdf/for_each_texel.h"

#include <algorithm>
#include <cmath>

namespace abrdf {

void finishTexels(AbrdfTile& abrdfs, const AngularGrid& grid, const PackOptions& options) {
    const double leastCosine = std::cos(radiansFromDegrees(89.9));
    std::vector<float> factors;
    for (const Direction& light : grid.lights()) {
        factors.push_back(static_cast<float>(1 / std::max(leastCosine, std::cos(light.theta))));
    }
    const std::size_t views = grid.views().size();
    forEachTexelBlock(abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        const std::span<Rgb> abrdf = abrdfs[texel];
        if (options.divideCosine) {
            for (std::size_t pair = 0; pair < abrdf.size(); ++pair)
                abrdf[pair] *= factors[pair / views];
        }
        if (!options.toOutputSpace.isIdentity()) options.toOutputSpace.apply(abrdf);
    });
}

AtlasBlock packAngular(const AbrdfTile& abrdfs, const AtlasLayout& layout, int firstRow, int rows) {
    AtlasBlock block{0, firstRow * layout.lights, layout.width(), rows * layout.lights, {}};
    const auto width = static_cast<std::size_t>(block.width);
    const auto views = static_cast<std::size_t>(layout.views);
    const auto lights = static_cast<std::size_t>(layout.lights);
    const auto texelsWide = static_cast<std::size_t>(layout.texelsWide);
    block.pixels.resize(width * static_cast<std::size_t>(block.height));
    forEachTexelBlock(abrdfs.texelCount(), 1, [&](std::size_t texel, std::size_t) {
        const std::size_t x = (texel % texelsWide) * views;
        const std::size_t y = (texel / texelsWide) * lights;
        for (std::size_t light = 0; light < lights; ++light) {
            std::ranges::copy(
                abrdfs[texel].subspan(light * views, views),
                block.pixels.begin() + static_cast<std::ptrdiff_t>((y + light) * width + x));
        }
    });
    return block;
}

AtlasBlock packSpatial(const AbrdfTile& abrdfs, const AtlasLayout& layout) {
    AtlasBlock block{0, 0, layout.width(), layout.height(), {}};
    const auto width = static_cast<std::size_t>(block.width);
    const auto views = static_cast<std::size_t>(layout.views);
    const auto texelsWide = static_cast<std::size_t>(layout.texelsWide);
    block.pixels.resize(width * static_cast<std::size_t>(block.height));
    forEachTexelBlock(static_cast<std::size_t>(block.height), 1, [&](std::size_t y, std::size_t) {
        const std::size_t light = y / static_cast<std::size_t>(layout.texelsHigh);
        const std::size_t texelY = y % static_cast<std::size_t>(layout.texelsHigh);
        for (std::size_t x = 0; x < width; ++x) {
            const std::size_t texel = texelY * texelsWide + x % texelsWide;
            block.pixels[y * width + x] = abrdfs[texel][light * views + x / texelsWide];
        }
    });
    return block;
}

}  // namespace abrdf
