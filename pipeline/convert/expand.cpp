// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/expand.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/scratch_file.h"
#include "abrdf/stopwatch.h"
#include "color/color_config.h"
#include "color/known_space.h"
#include "pipeline/convert/write_atlas.h"
#include "pipeline/job.h"
#include "pipeline/process_memory.h"
#include "stages/read/model_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// All that makes texels of an atlas from those of a model.
class Expander {
  public:
    Expander(const ModelAtlas& model, const AngularGrid& grid, const ExpandOptions& options,
             const TileOrder& order, TexelFinisher finisher)
        : model_(model),
          grazing_(grid, model.header.maxMeasuredTheta, options.grazing, model.header.cosine),
          finisher_(std::move(finisher)),
          pairs_(grid.pairCount()),
          texelOf_(model.texels.count()) {
        const std::vector<std::size_t> rows = texelRange(0, texelOf_.size());
        order.reorder<std::size_t>(rows, texelOf_);
        if (isSame(grazing_.inner(), model.header.grid)) return;
        const PairInterpolation interpolation(model.header.grid);
        for (const LightAndView& pair : pairsOf(grazing_.inner())) {
            weights_.push_back(interpolation.weights(pair));
        }
    }

    std::uint64_t extrapolatedPairs() const { return grazing_.extrapolatedPairs(); }

    /// Cells [first, first + count) of the atlas.
    void make(std::size_t first, std::size_t count, TexelMaker::Buffers& texels) const {
        const auto which = std::span(texelOf_).subspan(first, count);
        const std::size_t own = model_.model.pairs();
        const std::size_t inner = grazing_.inner().pairCount();
        std::vector<Rgb> values(count * own);
        texels.unreal = evaluateTexels(model_, model_.model, which, values);
        if (!weights_.empty()) values = interpolated(values, count);
        texels.estimates.clear();
        for (const std::size_t t : which) {
            if (!model_.estimates.empty()) texels.estimates.push_back(model_.estimates[t]);
        }
        if (grazing_.isIdentity()) {
            texels.abrdfs = std::move(values);
        } else {
            texels.abrdfs.resize(count * pairs_);
            for (std::size_t t = 0; t < count; ++t) {
                grazing_.apply(std::span<const Rgb>(values).subspan(t * inner, inner),
                               std::span(texels.abrdfs).subspan(t * pairs_, pairs_));
            }
        }
        finisher_.finish(texels.abrdfs);
    }

  private:
    static bool isSame(const AngularGrid& a, const AngularGrid& b) {
        constexpr double kClose = 1e-10;  // Squared distance on both spheres: headers hold floats.
        if (a.lights().size() != b.lights().size() || a.views().size() != b.views().size()) {
            return false;
        }
        for (std::size_t pair = 0; pair < a.pairCount(); ++pair) {
            if (squaredDistance(a.pair(pair), b.pair(pair)) > kClose) return false;
        }
        return true;
    }

    std::vector<Rgb> interpolated(const std::vector<Rgb>& values, std::size_t count) const {
        const std::size_t own = model_.model.pairs();
        std::vector<Rgb> result(count * weights_.size());
        for (std::size_t t = 0; t < count; ++t) {
            for (std::size_t i = 0; i < weights_.size(); ++i) {
                Rgb sum;
                for (const WeightedPair& term : weights_[i]) {
                    sum += term.weight * values[t * own + term.pair];
                }
                result[t * weights_.size() + i] = {std::max(sum.r, 0.0F), std::max(sum.g, 0.0F),
                                                   std::max(sum.b, 0.0F)};
            }
        }
        return result;
    }

    const ModelAtlas& model_;
    GrazingMap grazing_;
    TexelFinisher finisher_;
    std::size_t pairs_;
    std::vector<std::size_t> texelOf_;                ///< Of each cell.
    std::vector<std::vector<WeightedPair>> weights_;  ///< Empty where the grids are one.
};

AtlasHeader headerOf(const ModelAtlas& model, const AngularGrid& grid, const ExpandOptions& options,
                     const ColorConfig& colors) {
    AtlasHeader header = model.header;
    header.grid = grid;
    header.layout.kind = options.layout;
    header.layout.lights = static_cast<int>(grid.lights().size());
    header.layout.views = static_cast<int>(grid.views().size());
    if (options.divideCosine && header.cosine == Cosine::kKept) header.cosine = Cosine::kDivided;
    if (!options.outputSpace.empty()) {
        header.colorSpace = colors.spaceName(options.outputSpace);
        const auto known = knownSpace(colors.aliases(header.colorSpace));
        header.interopId = known ? std::string(interopId(*known)) : "unknown";
        header.conversion += " -> " + header.colorSpace;
    }
    return header;
}

MemoryPlan memoryOf(const ModelAtlas& model, const AtlasHeader& header,
                    const ExpandOptions& options) {
    MemoryTask task;
    task.layout = header.layout;
    task.type = options.pixel == PixelChoice::kHalf ? PixelType::kHalf : PixelType::kFloat;
    task.reconstructed = model.model.pairs();
    task.threads = threadsInUse();
    task.fixedBytes = residentMemory();
    return planMemory(task, options.memory);
}

struct Expanded {
    std::uint64_t bytes = 0;
    PixelType type = PixelType::kHalf;
    ValueCounts counts;
};

/// Nothing where a half cannot hold a value and should not have to.
std::optional<Expanded> expandAs(PixelType type, const ModelAtlas& model, const Expander& expander,
                                 const AtlasHeader& header, const ExpandOptions& options,
                                 const ProgressSink& progress) {
    const MemoryPlan memory = memoryOf(model, header, options);
    const TransposedTable none(
        0, sizeof(Rgb),
        bandBegins(texelOrderOf(header.layout), memory.runsPerBand * memory.runTiles), {});
    const bool hasEstimate = !model.estimates.empty();
    AtlasWriter writer(options.output, header, {type, options.compression, false, {}, hasEstimate});
    AtlasRun run{none,
                 [&](std::span<const Rgb>, std::size_t, std::size_t first, std::size_t count,
                     TexelMaker::Buffers& texels) { expander.make(first, count, texels); },
                 header.grid.pairCount(),
                 header.layout,
                 memory,
                 type,
                 options.pixel == PixelChoice::kAuto && type == PixelType::kHalf,
                 scratchFolder(options.output)};
    Expanded made{0, type, header.counts};
    const auto told = [&](const TilesAdded& added) {
        made.counts.clamped += added.counts.clamped;
        made.counts.nonfinite += added.counts.nonfinite;
    };
    if (!writeTiles(run, writer, told, progress)) return {};
    made.bytes = writer.finish(made.counts);
    return made;
}

}  // namespace

ordered_json expand(const ExpandOptions& options, const ProgressSink& progress) {
    const Stopwatch time;
    checkOutputPath(options.output, options.input);
    if (options.layout == AtlasKind::kModel) {
        throw std::invalid_argument("expand makes atlases of layout angular or spatial");
    }
    const ModelAtlas model = readModelAtlas(options.input);
    const ColorConfig colors = ColorConfig::load(options.colorConfig);
    const AngularGrid grid =
        options.grid == "input" ? model.header.grid : gridFromName(options.grid);
    AtlasHeader header = headerOf(model, grid, options, colors);
    const Expander expander(
        model, grid, options, texelOrderOf(header.layout),
        TexelFinisher(grid, {colors.transform(model.header.colorSpace, header.colorSpace),
                             header.cosine == Cosine::kDivided}));
    header.counts.extrapolated = expander.extrapolatedPairs() * header.layout.texelCount();
    auto made = expandAs(firstType(options.pixel), model, expander, header, options, progress);
    if (!made) made = expandAs(PixelType::kFloat, model, expander, header, options, progress);
    return {{"command", "expand"},
            {"version", ABRDF_VERSION},
            {"input", options.input.filename().string()},
            {"texels", {header.layout.texelsWide, header.layout.texelsHigh}},
            {"grid", {{"lights", header.layout.lights}, {"views", header.layout.views}}},
            {"counts",
             {{"clamped", made->counts.clamped},
              {"extrapolated", made->counts.extrapolated},
              {"nonfinite", made->counts.nonfinite}}},
            {"time", {{"total", time.seconds()}}},
            {"peak_memory", peakMemory()},
            {"output",
             {{"path", options.output.string()},
              {"bytes", made->bytes},
              {"pixel", nameOf(made->type)}}}};
}

}  // namespace abrdf
