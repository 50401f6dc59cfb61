// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/model_writer.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/model_parts.h"
#include "stages/write/picture_exr.h"

#include <fmt/format.h>

#include <string>

namespace abrdf {

namespace {

ExrPart partOf(const std::string& name, int width, int height) {
    return {name, width, height, {}, "", "data", {}, {}, nullptr};
}

ExrPart mapOf(const std::string& name, const AtlasLayout& layout) {
    return partOf(name, layout.texelsWide, layout.texelsHigh);
}

template <typename Get>
std::vector<float> channelOf(std::size_t count, const Get& get) {
    std::vector<float> channel(count);
    for (std::size_t i = 0; i < count; ++i) channel[i] = get(i);
    return channel;
}

/// The pair whose directions are nearest to the normal.
std::size_t frontPair(const AngularGrid& grid) {
    const Direction normal{0, 0};
    return grid.pairIndex(nearestDirection(grid.lights(), normal),
                          nearestDirection(grid.views(), normal));
}

ExrPart rgbPart(const ModelAtlas& atlas) {
    ExrPart part = mapOf("rgb", atlas.header.layout);
    const std::array<std::size_t, 1> front = {frontPair(atlas.header.grid)};
    const TexelModel model = atlas.model.restricted(front);
    std::vector<Rgb> colors(atlas.texels.count());
    forEachTexelBlock(colors.size(), 256, [&](std::size_t begin, std::size_t end) {
        evaluateTexels(atlas, model, texelRange(begin, end),
                       std::span(colors).subspan(begin, end - begin));
    });
    part.channels = {{"R", channelOf(colors.size(), [&](auto i) { return colors[i].r; }), false},
                     {"G", channelOf(colors.size(), [&](auto i) { return colors[i].g; }), false},
                     {"B", channelOf(colors.size(), [&](auto i) { return colors[i].b; }), false}};
    part.atlas = &atlas.header;
    const TexelRule& rule = atlas.model.rule();
    part.numbers = {{kModelCap, rule.cap},
                    {kModelFloor, rule.floor},
                    {kModelBlend, rule.blend},
                    {kModelIsotropic, atlas.model.hasIsotropic() ? 1.0F : 0.0F}};
    return part;
}

ExrPart texelsPart(const ModelAtlas& atlas) {
    ExrPart part = mapOf(kTexelsPart, atlas.header.layout);
    const PackedCodes& texels = atlas.texels;
    const auto add = [&](const char* name, const auto& get) {
        part.channels.push_back({name, channelOf(texels.count(), get), false});
    };
    add("rank", [&](auto t) { return static_cast<float>(texels.rank(t)); });
    add("most", [&](auto t) { return atlas.most[t]; });
    add("scale.Y", [&](auto t) { return texels.scale(t).luminance; });
    add("scale.R", [&](auto t) { return texels.scale(t).channel.r; });
    add("scale.G", [&](auto t) { return texels.scale(t).channel.g; });
    add("scale.B", [&](auto t) { return texels.scale(t).channel.b; });
    add("mean.R", [&](auto t) { return texels.scale(t).meanChroma[0]; });
    add("mean.G", [&](auto t) { return texels.scale(t).meanChroma[1]; });
    return part;
}

ExrPart coefficientsPart(const ModelAtlas& atlas, PixelType type) {
    ExrPart part = mapOf(kCoefficientsPart, atlas.header.layout);
    const std::vector<std::string> names = vectorNames(atlas.model.rule());
    for (std::size_t v = 0; v < names.size(); ++v) {
        for (std::size_t k = 0; k < atlas.texels.largestRank(); ++k) {
            part.channels.push_back(
                {coefficientName(names[v], k),
                 channelOf(atlas.texels.count(),
                           [&](auto t) { return atlas.texels.number(t, v, k); }),
                 type == PixelType::kHalf});
        }
    }
    return part;
}

ExrPart matrixPart(const std::string& name, const PackedMatrix& matrix) {
    const std::size_t columns = matrix.columns();
    ExrPart part = partOf(name, static_cast<int>(columns), static_cast<int>(matrix.rows()));
    part.channels = {{kBasisChannel,
                      channelOf(matrix.rows() * columns,
                                [&](auto i) { return matrix.at(i / columns, i % columns); }),
                      false}};
    return part;
}

ExrPart centersPart(const TexelModel& model) {
    const std::size_t vectors = model.rule().vectors();
    const std::size_t rows = model.basis().rows();
    ExrPart part = partOf(kCentersPart, static_cast<int>(vectors), static_cast<int>(rows));
    const std::size_t logs = model.rule().logVectors();
    part.channels = {{kBasisChannel,
                      channelOf(rows * vectors,
                                [&](auto i) {
                                    const std::size_t v = i % vectors;
                                    const TexelBasis& b = model.basis();
                                    return v < logs ? b.logCenters[v][i / vectors]
                                                    : b.chromaCenters[v - logs][i / vectors];
                                }),
                      false}};
    return part;
}

ExrPart rowsPart(const TexelModel& model) {
    ExrPart part = partOf(kRowsPart, static_cast<int>(model.pairs()), 1);
    part.channels = {
        {kBasisChannel,
         channelOf(model.pairs(), [&](auto i) { return static_cast<float>(model.rowOf()[i]); }),
         false}};
    return part;
}

}  // namespace

std::uint64_t writeModelAtlas(const std::filesystem::path& path, const ModelAtlas& atlas,
                              PixelType type) {
    std::vector<ExrPart> parts = {rgbPart(atlas)};
    if (!atlas.estimates.empty()) {
        parts.push_back(mapOf("estimate", atlas.header.layout));
        parts.back().channels = {{"deltaE", atlas.estimates, false}};
    }
    parts.push_back(texelsPart(atlas));
    const std::size_t largest = atlas.texels.largestRank();
    if (largest > 0) parts.push_back(coefficientsPart(atlas, type));
    const TexelBasis* small = atlas.model.small();
    if (small != nullptr) {
        parts.push_back(matrixPart(kLuminancePart, small->luminance));
        parts.push_back(matrixPart(kChromaPart, small->chroma));
    }
    if (small == nullptr || largest == atlas.model.columns()) {
        parts.push_back(matrixPart(kWholeLuminancePart, atlas.model.basis().luminance));
        parts.push_back(matrixPart(kWholeChromaPart, atlas.model.basis().chroma));
    }
    parts.push_back(centersPart(atlas.model));
    parts.push_back(rowsPart(atlas.model));
    return writeExrParts(path, parts);
}

}  // namespace abrdf
