// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/synthetic_atlas.h"

#include "stages/write/atlas_writer.h"

#include <cmath>

namespace abrdf {

Atlas syntheticAtlas(const AngularGrid& grid, int width, int height,
                     const std::function<Rgb(const LightAndView&, int, int)>& value,
                     Cosine cosine) {
    AtlasHeader header;
    header.grid = grid;
    header.layout = {AtlasKind::kAngular, width, height, static_cast<int>(grid.lights().size()),
                     static_cast<int>(grid.views().size())};
    header.cosine = cosine;
    header.method = "measured";
    header.plan = "all";
    header.source = "synthetic";
    header.maxMeasuredTheta = grid.maxTheta();
    header.colorSpace = "Linear Rec.709 (sRGB)";
    header.interopId = "lin_rec709_scene";
    std::vector<Rgb> pixels(header.layout.texelCount() * grid.pairCount());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto columns = static_cast<std::size_t>(header.layout.width());
        const AtlasSample s = header.layout.sampleFromPixel(
            {static_cast<int>(i % columns), static_cast<int>(i / columns)});
        const std::size_t pair =
            grid.pairIndex(static_cast<std::size_t>(s.light), static_cast<std::size_t>(s.view));
        pixels[i] = value(grid.pair(pair), s.texelX, s.texelY);
    }
    return {std::move(header), std::move(pixels)};
}

Rgb lambertianWithGloss(const LightAndView& pair, Rgb albedo, double gloss, double width) {
    const Imath::V3d light = vectorFromDirection(pair.light);
    const Imath::V3d half = (light + vectorFromDirection(pair.view)).normalized();
    const double off = std::acos(std::min(1.0, half.z)) / width;
    const double lobe = gloss * std::exp(-off * off);
    const auto cosine = static_cast<float>(light.z);
    const auto spike = static_cast<float>(lobe * light.z);
    return cosine * albedo + Rgb{spike, spike, spike};
}

void writeAtlas(const std::filesystem::path& path, const Atlas& atlas) {
    AtlasWriter writer(path, atlas.header(), {PixelType::kFloat, Compression::kZip, false, {}});
    writer.writeRows(0, atlas.header().layout.height(), atlas.pixels());
    writer.finish({});
}

}  // namespace abrdf
