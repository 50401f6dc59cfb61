// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "color/known_space.h"
#include "pipeline/unshifted_texels.h"
#include "stages/pack/pack_texels.h"
#include "stages/slice/slice_texels.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// All that is decided before the first image is decoded.
struct Job {
    OpenedInput input;
    PlannedMethod planned;
    FoundPlane found;
    AngularGrid grid;
    GrazingMap grazing;  ///< From the elevations that are measured to the grid's.
    Texels texels;
    AtlasHeader header;

    AtlasLayout layout() const { return header.layout; }
    const SampleSet& samples() const { return planned.samples; }
};

AtlasHeader headerOf(const Job& job, const ConvertOptions& options) {
    const BtfDescription& description = job.input.description();
    AtlasHeader header;
    header.layout = {options.layout, job.texels.width, job.texels.height,
                     static_cast<int>(job.grid.lights().size()),
                     static_cast<int>(job.grid.views().size())};
    header.grid = job.grid;
    header.method = options.method.name;
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
    header.counts.missing = job.samples().filled;
    header.counts.extrapolated = job.grazing.extrapolatedPairs() * header.layout.texelCount();
    return header;
}

Job prepare(const ConvertOptions& options, const ProgressSink& progress) {
    checkOutputPath(options.output);
    if (fs::exists(options.output) && fs::equivalent(options.output, options.input.input)) {
        throw std::runtime_error(fmt::format("{}: is the input as well; choose another output",
                                             options.output.string()));
    }
    Job job;
    checkPlanChoice(methodFromName(options.method.name), options.method.plan);
    if (options.grid != "input") job.grid = gridFromName(options.grid);
    job.input = openInput(options.input);
    if (options.grid == "input") job.grid = job.input.description().grid;
    job.texels = resolvedTexels(options.texels, job.input.description());
    const BtfDescription& description = job.input.description();
    job.grazing =
        GrazingMap(job.grid, description.maxMeasuredTheta, options.grazing, description.cosine);
    job.planned = planMethod(options.method, job.input, job.grazing.inner(), progress);
    job.header = headerOf(job, options);
    const std::int64_t width = std::int64_t{job.texels.width} * job.layout().views;
    const std::int64_t height = std::int64_t{job.texels.height} * job.layout().lights;
    if (width > (1 << 30) || height > (1 << 30)) {
        throw std::invalid_argument(fmt::format(
            "an atlas of {} x {} pixels is too large; choose fewer texels or a smaller grid", width,
            height));
    }
    return job;
}

/// Rows of texels that are reconstructed and written at once: whole tiles, about 16 MB of values.
int rowsAtOnce(const Job& job, int tileHeight) {
    const AtlasLayout layout = job.layout();
    if (layout.kind == AtlasKind::kSpatial) return layout.texelsHigh;
    const std::uint64_t rowBytes =
        sizeof(Rgb) * job.grid.pairCount() * static_cast<std::uint64_t>(layout.texelsWide);
    const int rowsOfTile = tileHeight / layout.lights;
    const auto tiles = static_cast<int>((std::uint64_t{16} << 20) /
                                        (rowBytes * static_cast<std::uint64_t>(rowsOfTile)));
    return std::min(layout.texelsHigh, rowsOfTile * std::max(1, tiles));
}

struct Written {
    ValueCounts counts;
    std::uint64_t bytes = 0;
    double reconstructSeconds = 0;
    bool fits = true;  ///< False: a value is too large for half, and nothing was written.
};

/// All pairs of the grid, of `count` rows of aligned texels.
ReconstructedTexels reconstructRows(const Job& job, const ImageStack& stack,
                                    const Reconstructor& reconstructor, int first, int count) {
    const auto width = static_cast<std::size_t>(job.texels.width);
    const SlicedTexels sliced =
        sliceTexels(stack, job.samples(), static_cast<std::size_t>(first) * width,
                    static_cast<std::size_t>(count) * width);
    ReconstructedTexels texels =
        reconstructTexels(sliced.samples, job.grazing.inner(), reconstructor);
    if (!job.grazing.isIdentity()) texels.abrdfs = job.grazing.apply(texels.abrdfs);
    return texels;
}

/// Reconstructs, packs and writes all texels, block by block.
Written writeAtlas(const Job& job, const ImageStack& stack, const Reconstructor& reconstructor,
                   const ConvertOptions& options, PixelType type, const ProgressSink& progress) {
    const AtlasLayout layout = job.layout();
    const PackOptions pack{job.input.colors.transform("scene_linear", options.outputSpace),
                           job.header.cosine == Cosine::kDivided};
    AtlasWriter writer(options.output, job.header, type, options.compression);
    Written written;
    written.counts = job.header.counts;
    const int rows = rowsAtOnce(job, writer.tileHeight());
    const auto reconstructed = [&](int first, int count) {
        return reconstructRows(job, stack, reconstructor, first, count);
    };
    UnshiftedTexels unshifted(job.found.plane, job.input.description(), job.texels, job.grid,
                              reconstructed);
    const bool unshift = options.plane.unshift && job.found.plane.height != 0;
    for (int row = 0; row < layout.texelsHigh; row += rows) {
        const int count = std::min(rows, layout.texelsHigh - row);
        const auto width = static_cast<std::size_t>(layout.texelsWide);
        const auto start = Clock::now();
        ReconstructedTexels texels =
            unshift ? unshifted.rows(row, count) : reconstructed(row, count);
        written.reconstructSeconds += secondsSince(start);
        finishTexels(texels.abrdfs, job.grid, pack);
        written.counts.clamped += texels.clamped;
        written.counts.nonfinite += texels.nonfinite;
        if (options.pixel == PixelChoice::kAuto && type == PixelType::kHalf &&
            !fitsHalf(texels.abrdfs.values())) {
            written.fits = false;
            return written;
        }
        const AtlasBlock block = layout.kind == AtlasKind::kAngular
                                     ? packAngular(texels.abrdfs, layout, row, count)
                                     : packSpatial(texels.abrdfs, layout);
        written.counts.clamped += writer.writeRows(block.y, block.height, block.pixels);
        if (progress) {
            progress({"reconstruct", "texels", static_cast<std::size_t>(row + count) * width,
                      layout.texelCount()});
        }
    }
    written.bytes = writer.finish(written.counts);
    return written;
}

ordered_json reportOf(const Job& job, const ConvertOptions& options) {
    const BtfDescription& description = job.input.description();
    ordered_json report;
    report["command"] = "convert";
    report["version"] = ABRDF_VERSION;
    report["input"] = {{"format", description.format},
                       {"lights", description.grid.lights().size()},
                       {"views", description.grid.views().size()},
                       {"width", description.width},
                       {"height", description.height},
                       {"images", description.imageCount()},
                       {"below_horizon", description.belowHorizon},
                       {"cosine", nameOf(description.cosine)},
                       {"color_space", job.input.inputSpace}};
    report["plan"] = {{"name", job.header.plan},
                      {"samples", job.samples().count()},
                      {"images_read", job.samples().pairs.size()}};
    report["method"] = options.method.name;
    report["texels"] = {job.texels.width, job.texels.height};
    const ordered_json conversion = {{"what", description.source},
                                     {"from", job.input.inputSpace},
                                     {"to", job.header.colorSpace}};
    report["color"] = {{"config", job.input.colors.origin()},
                       {"conversions", ordered_json::array({conversion})}};
    report["grid"] = {{"lights", job.grid.lights().size()}, {"views", job.grid.views().size()}};
    report["grazing"] = nameOf(options.grazing);
    return report;
}

}  // namespace

ordered_json planConvert(const ConvertOptions& options) {
    const Job job = prepare(options, {});
    std::uint64_t inputBytes = 0;
    const bool hasImages = job.input.reader->table() == nullptr;
    std::vector<std::string> files;
    if (hasImages) {
        for (const std::size_t pair : job.samples().pairs) {
            inputBytes += job.input.reader->bytesOf(pair);
            files.push_back(job.input.reader->fileOf(pair));
        }
    }
    const std::uint64_t texels = job.layout().texelCount();
    const std::uint64_t values = texels * job.grid.pairCount();
    const std::uint64_t channelBytes = options.pixel == PixelChoice::kFloat ? 4 : 2;
    const int rows = rowsAtOnce(job, job.layout().lights);
    const std::uint64_t blockValues = job.grid.pairCount() * static_cast<std::uint64_t>(rows) *
                                      static_cast<std::uint64_t>(job.texels.width);
    ordered_json report = reportOf(job, options);
    report["dry_run"] = true;
    report["estimate"] = {
        {"bytes_read", inputBytes},
        {"memory", (std::uint64_t{40} << 20) + sizeof(Rgb) * texels * job.samples().pairs.size() +
                       (2 * sizeof(Rgb) + 3 * channelBytes) * blockValues},
        {"output_bytes_uncompressed", 3 * channelBytes * values}};
    report["images"] = files;
    return report;
}

ordered_json convert(const ConvertOptions& options, const ProgressSink& progress) {
    const auto start = Clock::now();
    Job job = prepare(options, progress);
    job.found = planeOf(job.planned, options.plane, job.input, job.texels, progress);
    const ReadStack read =
        readStack(job.input, job.samples(), job.texels, job.found.plane, progress);
    job.header.counts.nonfinite = read.leftOut;
    job.header.plane = options.plane.unshift ? 0 : job.found.plane.height;
    job.header.margin = marginOf(job.found.plane, job.input.description(), job.texels);
    job.header.counts.outside = read.outside;
    const double readSeconds = secondsSince(start);

    const auto reconstructor =
        buildReconstructor(options.method, job.planned, job.input, read.stack, progress);
    PixelType type = options.pixel == PixelChoice::kFloat ? PixelType::kFloat : PixelType::kHalf;
    Written written = writeAtlas(job, read.stack, *reconstructor, options, type, progress);
    if (!written.fits) {
        type = PixelType::kFloat;
        written = writeAtlas(job, read.stack, *reconstructor, options, type, progress);
    }
    ordered_json report = reportOf(job, options);
    report["plane"] = jsonOf(job.found, job.input.description().grid);
    report["counts"] = {{"clamped", written.counts.clamped},
                        {"extrapolated", written.counts.extrapolated},
                        {"nonfinite", written.counts.nonfinite},
                        {"missing", written.counts.missing},
                        {"outside", written.counts.outside}};
    const double total = secondsSince(start);
    report["time"] = {{"read", readSeconds},
                      {"align", job.found.seconds},
                      {"reconstruct", written.reconstructSeconds},
                      {"write", total - readSeconds - written.reconstructSeconds},
                      {"total", total}};
    report["peak_memory"] = peakMemory();
    report["output"] = {
        {"path", options.output.string()}, {"bytes", written.bytes}, {"pixel", nameOf(type)}};
    return report;
}

}  // namespace abrdf
