// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/job_identity.h"

#include "abrdf/content_hash.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <vector>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

/// A number for a list of directions.
std::uint64_t hashOf(const std::vector<Direction>& directions, std::uint64_t seed) {
    return contentHash(
        {reinterpret_cast<const char*>(directions.data()), directions.size() * sizeof(Direction)},
        seed);
}

std::string hex(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

}  // namespace

ordered_json askedOf(const ConvertJob& job, const ConvertOptions& options) {
    const MethodChoice& choice = job.method;
    std::uint64_t plan = job.samples().count();
    for (const LightAndView& pair : job.samples().directions) {
        plan = hashOf({pair.light, pair.view}, plan);
    }
    const std::uint64_t grid = hashOf(job.grid.views(), hashOf(job.grid.lights(), 0));
    const auto number = [](const std::optional<double>& value) {
        return value ? ordered_json(*value) : ordered_json("auto");
    };
    ordered_json asked = {
        {"version", ABRDF_VERSION},
        {"source", job.header.source},
        {"images", job.samples().pairs.size()},
        {"input_space", job.input.inputSpace},
        {"missing", options.input.missing == MissingImages::kFill ? "fill" : "error"},
        {"method", choice.name},
        {"plan", job.header.plan},
        {"samples", hex(plan)},
        {"noise", number(choice.noise)},
        {"saturated", number(choice.saturated)},
        {"rank", choice.options.rank},
        {"tolerance", choice.options.tolerance},
        {"exposure", choice.options.exposure},
        {"per_texel", choice.options.perTexel},
        {"grid", hex(grid)},
        {"grazing", nameOf(options.grazing)},
        {"texels", fmt::format("{}x{}", job.texels.width, job.texels.height)},
        {"plane", fmt::format("{:g} {}", job.found.plane.height,
                              job.found.plane.edges == Edges::kPeriodic ? "periodic" : "cropped")},
        {"layout", nameOf(options.layout)},
        {"pixel", options.pixel == PixelChoice::kAuto   ? "auto"
                  : options.pixel == PixelChoice::kHalf ? "half"
                                                        : "float"},
        {"compression", nameOf(options.compression)},
        {"output_space", job.header.colorSpace},
        {"cosine", options.divideCosine ? "divide" : "keep"}};
    if (job.scene) {
        const std::vector<double>& weights = job.planned.weights;
        asked["pairs"] = hex(contentHash(
            {reinterpret_cast<const char*>(weights.data()), weights.size() * sizeof(double)}));
    }
    return asked;
}

ordered_json identityOf(ordered_json asked, std::uint64_t hash, std::span<const Rgb> meanSamples,
                        const Reconstructor& reconstructor, std::size_t pairs) {
    std::vector<Rgb> mean(pairs);
    reconstructBlock(meanSamples, 1, reconstructor, mean);
    asked["values"] = hex(hash);
    asked["mean"] =
        hex(contentHash({reinterpret_cast<const char*>(mean.data()), mean.size() * sizeof(Rgb)}));
    return asked;
}

}  // namespace abrdf
