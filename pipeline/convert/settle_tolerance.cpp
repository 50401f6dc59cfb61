// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/settle_tolerance.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

std::string nameOf(std::uint16_t rank, const TexelModel& model) {
    if (rank == kConstantRank) return "constant";
    if (rank == model.columns()) return "whole";
    if (rank == kIsotropicRank && model.hasIsotropic()) return "isotropic";
    return fmt::format("rank {}", rank);
}

/// How small the models of some texels may be for a tolerance.
struct RankFacts {
    std::size_t texels = 0;  ///< That were looked at.
    std::size_t within = 0;  ///< Whose bound is within the tolerance.
    ordered_json ranks;      ///< How many texels took which: {"constant": 1, "rank 8": 3}.
    double cost = 1;         ///< Mean multiply-adds beside those of whole models.
};

/// images: how many were read. The reconstructor has a model.
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

}  // namespace

ordered_json settleTolerance(const ConvertJob& job, const ConvertOptions& options,
                             const Reconstructor& reconstructor, const TexelSlicer& slicer,
                             const ReadFacts& facts) {
    const double tolerance = job.method.options.tolerance;
    if (tolerance <= 0 || reconstructor.model() == nullptr) return nullptr;
    const RankFacts found =
        rankFacts(reconstructor, slicer, facts, job.samples().pairs.size(), tolerance);
    if (found.within < found.texels) {
        const std::string what = fmt::format(
            "of {} texels that were looked at, {} cannot be known to be within {:g} Delta E from "
            "{} samples",
            found.texels, found.texels - found.within, tolerance, job.samples().count());
        if (options.limits.strict) {
            throw std::runtime_error(fmt::format("{}: {}; take more of them, or leave --strict out",
                                                 options.output.string(), what));
        }
        if (job.input.warn) job.input.warn(what + "; these take the whole model");
    }
    return {{"tolerance", tolerance},
            {"of_texels", found.texels},
            {"within", found.within},
            {"ranks", found.ranks},
            {"cost", found.cost}};
}

}  // namespace abrdf
