// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate_sheet.h"

#include <fmt/format.h>

namespace abrdf {

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

std::vector<Rgb> imageOf(const AbrdfTile& tile, std::size_t pair) {
    std::vector<Rgb> image(tile.texelCount());
    for (std::size_t t = 0; t < image.size(); ++t) image[t] = tile[t][pair];
    return image;
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

}  // namespace abrdf
