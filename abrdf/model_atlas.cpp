// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/model_atlas.h"

#include "abrdf/for_each_texel.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace abrdf {

UnrealCounts evaluateTexels(const ModelAtlas& atlas, const TexelModel& model,
                            std::span<const std::size_t> texels, std::span<Rgb> abrdfs) {
    model.evaluate(atlas.texels.unpacked(texels), abrdfs);
    const std::size_t pairs = model.pairs();
    UnrealCounts counts;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        makeLights(abrdfs.subspan(i * pairs, pairs), atlas.most[texels[i]], counts);
    }
    return counts;
}

std::vector<std::size_t> texelRange(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> texels(end - begin);
    std::iota(texels.begin(), texels.end(), begin);
    return texels;
}

Atlas expanded(const ModelAtlas& atlas) {
    AtlasHeader header = atlas.header;
    header.layout.kind = AtlasKind::kAngular;
    const AtlasLayout layout = header.layout;
    const std::size_t pairs = atlas.model.pairs();
    const auto views = static_cast<std::size_t>(layout.views);
    const auto wide = static_cast<std::size_t>(layout.texelsWide);
    std::vector<Rgb> pixels(layout.texelCount() * pairs);
    constexpr std::size_t kTexels = 32;
    forEachTexelBlock(layout.texelCount(), kTexels, [&](std::size_t begin, std::size_t end) {
        std::vector<Rgb> abrdfs((end - begin) * pairs);
        evaluateTexels(atlas, atlas.model, texelRange(begin, end), abrdfs);
        for (std::size_t i = 0; i < abrdfs.size(); i += views) {  // A light's views are a line.
            const std::size_t texel = begin + i / pairs;
            const AtlasPixel p = layout.pixelFromSample({static_cast<int>(texel % wide),
                                                         static_cast<int>(texel / wide),
                                                         static_cast<int>(i % pairs / views), 0});
            std::copy_n(abrdfs.begin() + static_cast<std::ptrdiff_t>(i), views,
                        pixels.begin() + static_cast<std::ptrdiff_t>(p.y) * layout.width() + p.x);
        }
    });
    return {std::move(header), std::move(pixels)};
}

Rgb lookUp(const ModelAtlas& atlas, const PairInterpolation& interpolation, Direction light,
           Direction view, int texelX, int texelY) {
    const AtlasLayout& layout = atlas.header.layout;
    if (texelX < 0 || texelY < 0 || texelX >= layout.texelsWide || texelY >= layout.texelsHigh) {
        throw std::out_of_range(fmt::format("texel {},{} is not in an atlas of {} x {} texels",
                                            texelX, texelY, layout.texelsWide, layout.texelsHigh));
    }
    const auto texel =
        static_cast<std::size_t>(texelY) * static_cast<std::size_t>(layout.texelsWide) +
        static_cast<std::size_t>(texelX);
    const TexelCodes codes = atlas.texels.unpacked(std::span(&texel, 1));
    Rgb sum;
    UnrealCounts uncounted;
    for (const WeightedPair& term : interpolation.weights({light, view})) {
        Rgb value = atlas.model.at(codes, 0, term.pair);
        makeLights({&value, 1}, atlas.most[texel], uncounted);
        sum += term.weight * value;
    }
    return sum;
}

}  // namespace abrdf
