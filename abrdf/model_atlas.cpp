// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/model_atlas.h"

#include "abrdf/for_each_texel.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace abrdf {

namespace {

Rgb bounded(Rgb value, float most) {
    if (!isFinite(value)) return {};
    if (isNegative(value)) {
        value = {std::max(value.r, 0.0F), std::max(value.g, 0.0F), std::max(value.b, 0.0F)};
    }
    const float largest = std::max({value.r, value.g, value.b});
    return largest > most ? (most / largest) * value : value;
}

}  // namespace

void evaluateTexels(const ModelAtlas& atlas, const TexelModel& model,
                    std::span<const std::size_t> texels, std::span<Rgb> abrdfs) {
    model.evaluate(atlas.texels.unpacked(texels), abrdfs);
    const std::size_t pairs = model.pairs();
    for (std::size_t i = 0; i < texels.size() * pairs; ++i) {
        abrdfs[i] = bounded(abrdfs[i], atlas.most[texels[i / pairs]]);
    }
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
    for (const WeightedPair& term : interpolation.weights({light, view})) {
        sum += term.weight * bounded(atlas.model.at(codes, 0, term.pair), atlas.most[texel]);
    }
    return sum;
}

}  // namespace abrdf
