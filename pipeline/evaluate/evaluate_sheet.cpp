// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate_sheet.h"

#include "pipeline/named_pair.h"

#include <fmt/format.h>

#include <algorithm>

namespace abrdf {

namespace {

/// The image of a pair.
std::vector<Rgb> imageOf(const AbrdfTile& tile, std::size_t pair) {
    std::vector<Rgb> image(tile.texelCount());
    for (std::size_t t = 0; t < image.size(); ++t) image[t] = tile[t][pair];
    return image;
}

}  // namespace

std::vector<Rgb> meanAbrdf(const AbrdfTile& tile) {
    std::vector<Rgb> mean(tile.valuesPerTexel());
    std::vector<float> counts(mean.size());
    for (std::size_t t = 0; t < tile.texelCount(); ++t) {
        for (std::size_t pair = 0; pair < mean.size(); ++pair) {
            if (!isFinite(tile[t][pair])) continue;
            mean[pair] += tile[t][pair];
            ++counts[pair];
        }
    }
    for (std::size_t pair = 0; pair < mean.size(); ++pair) mean[pair] *= 1 / counts[pair];
    return mean;
}

SheetRow sheetRowOf(const nlohmann::ordered_json& result, const AbrdfTile& abrdfs) {
    return {
        fmt::format("{}, plan {}, {} samples", result["method"].get<std::string>(),
                    result["plan"].get<std::string>(), result["samples"].get<std::size_t>()),
        fmt::format("Delta E {:.2f}   PSNR {:.1f} dB   {} images", result["delta_e"].get<double>(),
                    result["psnr"].get<double>(), result["images_read"].get<std::size_t>()),
        meanAbrdf(abrdfs),
        {}};
}

std::vector<SheetImage> sheetImages(const Reference& reference,
                                    const EvaluatedMethod& reconstruction, const AngularGrid& grid,
                                    const std::vector<LightAndView>& wanted) {
    const std::vector<std::size_t>& sampled = reconstruction.planned.samples.pairs;
    std::vector<SheetImage> images;
    for (const LightAndView& place : wanted) {
        std::size_t best = 0;
        for (std::size_t pair = 0; pair < grid.pairCount(); ++pair) {
            if (reference.present[pair] != 0 &&
                squaredDistance(grid.pair(pair), place) < squaredDistance(grid.pair(best), place)) {
                best = pair;
            }
        }
        const bool isSampled = std::ranges::binary_search(sampled, best);
        images.push_back({fmt::format("{}, {}", pairName(grid.pair(best)),
                                      isSampled ? "a sample" : "not sampled"),
                          imageOf(reference.truth, best), imageOf(reconstruction.abrdfs, best)});
    }
    return images;
}

}  // namespace abrdf
