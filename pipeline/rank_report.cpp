// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/rank_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>

namespace abrdf {

namespace {

std::string nameOf(std::uint16_t rank, const TexelModel& model) {
    if (rank == kConstantRank) return "constant";
    if (rank == model.columns()) return "whole";
    if (rank == kIsotropicRank && model.hasIsotropic()) return "isotropic";
    return fmt::format("rank {}", rank);
}

}  // namespace

RankFacts rankFacts(const Reconstructor& reconstructor, const TexelSlicer& slicer,
                    const ReadFacts& facts, std::size_t images, double tolerance) {
    const std::vector<Rgb>& band = facts.someTexels.empty() ? facts.means : facts.someTexels;
    RankFacts found;
    found.texels = band.size() / images;
    std::vector<Rgb> samples(found.texels * slicer.sampleCount());
    slicer.slice(band, 0, samples);
    std::map<std::uint16_t, std::size_t> counts;
    double cost = 0;
    const std::size_t atOnce = reconstructor.texelsAtOnce();
    for (std::size_t first = 0; first < found.texels; first += atOnce) {
        const std::size_t count = std::min(atOnce, found.texels - first);
        std::vector<float> bounds(count);
        const TexelCodes codes = reconstructor.encode(
            std::span(samples).subspan(first * slicer.sampleCount(), count * slicer.sampleCount()),
            bounds);
        for (std::size_t t = 0; t < count; ++t) {
            ++counts[codes.ranks[t]];
            cost += reconstructor.multiplyAddsOfRank(codes.ranks[t]);
            found.within += static_cast<double>(bounds[t]) <= tolerance ? 1U : 0U;
        }
    }
    const TexelModel& model = *reconstructor.model();
    found.cost = cost / static_cast<double>(found.texels) / model.multiplyAdds(model.columns());
    for (const auto& [rank, count] : counts) found.ranks[nameOf(rank, model)] = count;
    return found;
}

nlohmann::ordered_json jsonOf(const RankFacts& facts, double tolerance) {
    return {{"tolerance", tolerance},
            {"of_texels", facts.texels},
            {"within", facts.within},
            {"ranks", facts.ranks},
            {"cost", facts.cost}};
}

}  // namespace abrdf
