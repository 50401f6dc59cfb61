// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert_job.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "color/known_space.h"
#include "pipeline/process_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

AtlasHeader headerOf(const ConvertJob& job, const ConvertOptions& options) {
    const BtfDescription& description = job.input.description();
    AtlasHeader header;
    // A model knows the measured elevations; abrdf expand goes past them.
    header.grid = options.layout == AtlasKind::kModel ? job.grazing.inner() : job.grid;
    header.layout = {options.layout, job.texels.width, job.texels.height,
                     static_cast<int>(header.grid.lights().size()),
                     static_cast<int>(header.grid.views().size())};
    header.method = job.method.name;
    header.plan = job.planned.planName();
    header.samples = static_cast<int>(job.samples().count());
    header.source = description.source;
    header.cosine = options.divideCosine && description.cosine == Cosine::kKept
                        ? Cosine::kDivided
                        : description.cosine;
    header.maxMeasuredTheta = description.maxMeasuredTheta;
    header.colorSpace = job.input.colors.spaceName(options.outputSpace);
    header.conversion = fmt::format("{} -> {}", job.input.inputSpace, header.colorSpace);
    const auto known = knownSpace(job.input.colors.aliases(header.colorSpace));
    header.interopId = known ? std::string(interopId(*known)) : "unknown";
    header.plane = job.isUnshifted ? 0 : job.found.plane.height;
    header.margin = marginOf(job.found.plane, description, job.texels);
    header.counts.missing = job.samples().filled;
    if (options.layout != AtlasKind::kModel) {
        header.counts.extrapolated = job.grazing.extrapolatedPairs() * header.layout.texelCount();
    }
    return header;
}

/// Cuts the job to the rows of its shard: whole rows of an angular atlas's tiles.
void takeShard(ConvertJob& job, const Shard& shard) {
    if (shard.count == 1) return;
    AtlasHeader& header = job.header;
    header.layout.kind = AtlasKind::kAngular;
    const TileOrder order = tileOrderOf(header.layout);
    if (shard.count > order.tilesHigh()) {
        throw std::invalid_argument(
            fmt::format("--shard {}/{}: an atlas of {} rows of texels cannot be cut into more than "
                        "{} shards",
                        shard.index, shard.count, job.texels.height, order.tilesHigh()));
    }
    const auto rowOf = [&](int index) {
        const std::int64_t tile = std::int64_t{order.tilesHigh()} * index / shard.count;
        return std::min(job.texels.height, static_cast<int>(tile) * order.tileHeight());
    };
    job.firstRow = rowOf(shard.index - 1);
    header.layout.texelsHigh = rowOf(shard.index) - job.firstRow;
    header.shard = shard.index;
    header.shards = shard.count;
    // What belongs to the whole atlas is counted in its first shard.
    if (shard.index > 1) header.counts = {};
}

/// Bytes to decode and average one image.
std::uint64_t imageBytes(const ConvertJob& job) {
    const BtfDescription& description = job.input.description();
    const std::uint64_t pixels = static_cast<std::uint64_t>(description.width) *
                                 static_cast<std::uint64_t>(description.height);
    const bool isFull = job.texels.count() == pixels;
    const std::uint64_t codes = job.input.hasCodes() ? 3 : sizeof(Rgb);
    const std::uint64_t sums = isFull ? 0 : 32 * job.texels.count();
    const std::uint64_t shifted = job.found.plane.height != 0 ? 2 * sizeof(Rgb) * pixels : 0;
    return pixels * 2 * codes + shifted + sums + 2 * sizeof(Rgb) * job.texels.count();
}

MemoryTask memoryOf(const ConvertJob& job, const ConvertOptions& options) {
    MemoryTask task;
    task.layout = job.layout();
    if (task.layout.kind == AtlasKind::kModel) {
        task.layout.kind = AtlasKind::kSpatial;  // Texel by texel, and hardly anything to write.
        task.layout.lights = task.layout.views = 1;
    }
    // Room for what auto may turn to.
    task.type = options.pixel == PixelChoice::kHalf ? PixelType::kHalf : PixelType::kFloat;
    task.images = job.samples().pairs.size();
    task.samples = job.samples().count();
    task.reconstructed = job.grazing.inner().pairCount();
    task.imageBytes = imageBytes(job);
    task.threads = threadsInUse();
    task.fixedBytes = residentMemory();
    if (job.planned.method->needsPrior) {
        // The model's covariances of four classes, and the products made of them in double.
        task.fixedBytes += 40 * std::uint64_t{task.samples} * task.reconstructed;
        // Estimates, as an earlier run left them, in the order of tiles, in rows, and as a chunk.
        task.fixedBytes += 4 * sizeof(float) * job.layout().texelCount();
    }
    return task;
}

void checkSize(const ConvertJob& job) {
    const AtlasLayout& layout = job.layout();
    if (layout.kind == AtlasKind::kModel) return;
    const std::int64_t width = std::int64_t{layout.texelsWide} * layout.views;
    const std::int64_t height = std::int64_t{layout.texelsHigh} * layout.lights;
    constexpr std::int64_t kMost = std::int64_t{1} << 30;
    if (width <= kMost && height <= kMost) return;
    throw std::invalid_argument(fmt::format(
        "an atlas of {} x {} pixels is too large; choose fewer texels or a smaller grid", width,
        height));
}

void checkUnshift(const ConvertJob& job, const ConvertOptions& options) {
    if (!job.isUnshifted || (!options.resume && options.shard.count == 1)) return;
    throw std::invalid_argument(
        "--unshift makes each texel of many others, so that it can be neither resumed nor cut into "
        "shards; leave --resume and --shard out");
}

/// What a model atlas cannot be.
void checkModel(const ConvertJob& job, const ConvertOptions& options) {
    if (options.layout != AtlasKind::kModel) return;
    const std::string why = options.resume || options.shard.count > 1
                                ? "it is written at once; leave --resume and --shard out"
                            : job.isUnshifted ? "its texels are reconstructed; leave --unshift out"
                            : options.outputSpace != "scene_linear" || options.divideCosine
                                ? "it holds scene_linear values with their cosine; give "
                                  "--output-space and --cosine to abrdf expand"
                                : "";
    if (!why.empty()) throw std::invalid_argument("--layout model: " + why);
}

/// What the scene asks of the pairs that are reconstructed.
std::optional<SceneChoice> sceneOf(const ConvertJob& job, const ConvertOptions& options) {
    if (!job.scene) return {};
    return SceneChoice{
        {job.scene->name, job.grazing.innerWeights(sceneWeights(*job.scene, job.grid))},
        options.method.plan.isOpen()};
}

}  // namespace

TileOrder ConvertJob::texelOrder() const {
    return texelOrderOf(layout());
}

ConvertJob prepareConvert(const ConvertOptions& options, const ProgressSink& progress) {
    checkOutputPath(options.output, options.input.input);
    ConvertJob job;
    checkPlanChoice(methodFromName(options.method.name), options.method.plan);
    if (options.grid != "input") job.grid = gridFromName(options.grid);
    if (!options.pairs.empty()) job.scene = scenePairsFromCsv(options.pairs);
    job.input = openInput(options.input);
    if (options.grid == "input") job.grid = job.input.description().grid;
    if (job.scene) job.grid = sceneGrid(*job.scene, job.grid);
    job.texels = resolvedTexels(options.texels, job.input.description());
    const BtfDescription& description = job.input.description();
    job.grazing =
        GrazingMap(job.grid, description.maxMeasuredTheta, options.grazing, description.cosine);
    job.method = options.method;
    job.chosen =
        settleMethod(job.method, options.limits, job.grazing.inner().pairCount(), job.input.warn);
    const std::optional<SceneChoice> scene = sceneOf(job, options);
    const Stopwatch planning;
    job.planned =
        planMethod(job.method, job.input, job.grazing.inner(), progress, scene ? &*scene : nullptr);
    job.planSeconds = planning.seconds();
    job.found = planeOf(job.planned, options.plane, job.input, job.texels, progress);
    job.isUnshifted = options.plane.unshift && job.found.plane.height != 0;
    checkUnshift(job, options);
    checkModel(job, options);
    job.header = headerOf(job, options);
    takeShard(job, options.shard);
    checkSize(job);
    job.memory = memoryOf(job, options);
    return job;
}

}  // namespace abrdf
