// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert.h"

#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/convert/settle_tolerance.h"
#include "pipeline/convert/tile_journal.h"
#include "pipeline/convert/write_atlas.h"
#include "pipeline/convert/write_model.h"
#include "pipeline/convert/write_unshifted.h"
#include "pipeline/json_text.h"
#include "pipeline/process_memory.h"
#include "stages/read/atlas_reader.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

/// The samples of all texels, in memory or in a scratch file.
std::unique_ptr<TransposedTable> tableFor(const ConvertJob& job, const MemoryPlan& memory,
                                          const fs::path& output) {
    std::optional<fs::path> scratch;
    if (!memory.samplesInMemory) scratch = scratchFolder(output);
    return std::make_unique<TransposedTable>(
        job.samples().pairs.size(), sizeof(Rgb),
        bandBegins(job.texelOrder(), memory.runsPerBand * memory.runTiles), scratch);
}

/// Reads all images and turns them into columns of texels.
ReadFacts readTexels(const ConvertJob& job, const MemoryPlan& memory, TransposedTable& table,
                     const ProgressSink& progress) {
    const TileOrder order = job.texelOrder();
    const auto store = [&](std::size_t image, std::span<const Rgb> texels) {
        std::span<const Rgb> rows = job.rowsOf(texels);
        std::vector<Rgb> ordered(order.isRowOrder() ? 0 : rows.size());
        if (!ordered.empty()) {
            order.reorder<Rgb>(rows, ordered);
            rows = ordered;
        }
        table.store(image, {reinterpret_cast<const char*>(rows.data()), rows.size_bytes()});
    };
    return readImages(job.input, job.samples(), job.texels, job.found.plane, memory.readSlots,
                      store, progress);
}

struct Written {
    ValueCounts counts;
    std::uint64_t dimmed = 0;  ///< As UnrealCounts.
    PixelType type = PixelType::kHalf;
    std::uint64_t bytes = 0;
    std::size_t resumedTiles = 0;
    double writeSeconds = 0;
    std::vector<float> estimates = {};  ///< Delta E a texel; none where the method knows none.
};

/// Where an exception leaves it, the unfinished atlas goes, unless it is to be continued.
class UnfinishedAtlas {
  public:
    UnfinishedAtlas(TileJournal& journal, bool stays) : journal_(journal), stays_(stays) {}
    ~UnfinishedAtlas() {
        if (!stays_) journal_.remove();
    }
    UnfinishedAtlas(const UnfinishedAtlas&) = delete;
    UnfinishedAtlas& operator=(const UnfinishedAtlas&) = delete;

    void finish() { stays_ = false; }

  private:
    TileJournal& journal_;
    bool stays_;
};

/// Makes and writes all tiles, from where an earlier run stopped on.
Written writeAtlas(const ConvertJob& job, const ConvertOptions& options, const MemoryPlan& memory,
                   const TransposedTable& table, const TexelMaker& maker,
                   const ordered_json& identity, const ProgressSink& progress) {
    ordered_json journalled = identity;
    if (job.header.shard > 0) {
        journalled["shard"] = fmt::format("{}/{}", job.header.shard, job.header.shards);
    }
    const bool hasEstimate = maker.reconstructor.knowsError();
    if (hasEstimate) journalled["estimate"] = true;
    const PixelType first =
        options.pixel == PixelChoice::kFloat ? PixelType::kFloat : PixelType::kHalf;
    TileJournal journal(options.output, journalled, first, options.resume);
    UnfinishedAtlas unfinished(journal, options.resume);
    Written written;
    written.resumedTiles = journal.written().tiles;
    while (true) {
        written.type = journal.type();
        written.counts = job.header.counts;
        written.dimmed = 0;
        const auto add = [&](const UnrealCounts& counts) {
            written.counts.clamped += counts.clamped;
            written.counts.nonfinite += counts.nonfinite;
            written.dimmed += counts.dimmed;
        };
        add(journal.counts());
        AtlasWriter writer(
            options.output, job.header,
            {written.type, options.compression, true, journal.written(), hasEstimate});
        writer.keepEstimates(0, journal.estimates());
        if (journal.written().tiles == 0) journal.add({writer.written(), 0, {}});
        const bool endWhereCut =
            options.pixel == PixelChoice::kAuto && written.type == PixelType::kHalf;
        const auto make = [&](std::span<const Rgb> band, std::size_t inBand, std::size_t,
                              std::size_t count, TexelMaker::Buffers& texels) {
            maker.make(band, inBand, count, texels);
        };
        const AtlasRun run{table,  make,         maker.pairs, job.layout(),
                           memory, written.type, endWhereCut, scratchFolder(options.output)};
        const auto told = [&](const TilesAdded& added) {
            journal.add(added);
            add(added.counts);
            written.writeSeconds += added.seconds;
        };
        if (writeTiles(run, writer, told, progress)) {
            const Stopwatch finishing;
            written.bytes = writer.finish(written.counts);
            written.estimates = writer.estimates();
            written.writeSeconds += finishing.seconds();
            unfinished.finish();
            return written;
        }
        journal.restart(PixelType::kFloat);
    }
}

/// With --resume an atlas that is finished already is kept. Throws where it is of another job.
bool isFinished(const ConvertOptions& options, const ordered_json& asked, int shard) {
    if (!options.resume || !fs::exists(options.output) || fs::exists(partialBeside(options.output)))
        return false;
    ordered_json was;
    int wasShard = shard;
    if (isAtlas(options.output)) {
        const AtlasHeader header = readAtlasHeader(options.output);
        was = ordered_json::parse(header.job, nullptr, false);
        wasShard = header.shard;
    }
    if (!was.is_object()) {
        throw std::runtime_error(
            fmt::format("{}: exists, and does not tell of which job it is; remove it, or leave "
                        "--resume out to replace it",
                        options.output.string()));
    }
    was.erase("values");
    was.erase("mean");
    std::string changed = differences(was, asked);
    if (changed.empty() && wasShard != shard) changed = "it is another shard";
    if (changed.empty()) {
        TileJournal::removeFinished(options.output);
        return true;
    }
    throw std::runtime_error(
        fmt::format("{}: exists and is of another job: {}; remove it, or leave --resume out to "
                    "replace it",
                    options.output.string(), changed));
}

/// The report of a job that was finished before.
ordered_json finishedReport(const ConvertJob& job, const ConvertOptions& options,
                            const Stopwatch& time) {
    const AtlasHeader header = readAtlasHeader(options.output);
    ordered_json report = reportOf(job, options);
    report["counts"] = {{"clamped", header.counts.clamped},
                        {"extrapolated", header.counts.extrapolated},
                        {"nonfinite", header.counts.nonfinite},
                        {"missing", job.samples().filled}};
    addEstimate(readEstimates(options.output), report);
    report["time"] = {
        {"read", 0.0}, {"reconstruct", 0.0}, {"write", 0.0}, {"total", time.seconds()}};
    report["peak_memory"] = peakMemory();
    report["finished_before"] = true;
    report["output"] = {{"path", options.output.string()},
                        {"bytes", fs::file_size(options.output)}};
    return report;
}

}  // namespace

ordered_json planConvert(const ConvertOptions& options) {
    ConvertOptions still = options;
    still.plane.search = false;  // That would decode images.
    const ConvertJob job = prepareConvert(still, {});
    const MemoryPlan memory = planMemory(job.memory, options.memory);
    std::uint64_t inputBytes = 0;
    const bool hasImages = job.input.reader->table() == nullptr;
    std::vector<std::string> files;
    if (hasImages) {
        for (const std::size_t pair : job.samples().pairs) {
            inputBytes += job.input.reader->bytesOf(pair);
            files.push_back(job.input.reader->fileOf(pair));
        }
    }
    const std::uint64_t values = job.layout().texelCount() * job.grid.pairCount();
    ordered_json report = reportOf(job, options);
    report["dry_run"] = true;
    report["estimate"] = {
        {"bytes_read", inputBytes},
        {"memory", memory.peak},
        {"scratch_bytes", memory.scratchBytes},
        {"scratch_folder", scratchFolder(options.output).string()},
        {"output_bytes_uncompressed",
         3 * bytesOf(options.pixel == PixelChoice::kFloat ? PixelType::kFloat : PixelType::kHalf) *
             values}};
    report["images"] = files;
    return report;
}

namespace {

/// What the flow of tiles needs in memory beforehand: the aligned samples.
void checkUnshiftedMemory(const ConvertJob& job, const ConvertOptions& options) {
    const std::uint64_t samples =
        sizeof(Rgb) * job.samples().pairs.size() * job.texels.count() + job.memory.fixedBytes;
    const std::uint64_t rows = job.layout().kind == AtlasKind::kSpatial
                                   ? 3 * sizeof(Rgb) * job.grid.pairCount() * job.texels.count()
                                   : std::uint64_t{128} << 20;
    if (samples + rows <= options.memory) return;
    throw std::invalid_argument(
        fmt::format("--unshift holds all samples in memory, which is bounded to {} MB; give it "
                    "--memory {}M or more, or leave it out",
                    options.memory >> 20, ((samples + rows) >> 20) + 1));
}

ReadFacts countedIn(ConvertJob& job, ReadFacts facts) {
    if (job.header.shard <= 1) {
        job.header.counts.nonfinite = facts.leftOut;
        job.header.counts.outside = facts.outside;
    }
    return facts;
}

ordered_json countsOf(const ValueCounts& counts, std::uint64_t dimmed) {
    return {{"clamped", counts.clamped},     {"extrapolated", counts.extrapolated},
            {"nonfinite", counts.nonfinite}, {"missing", counts.missing},
            {"outside", counts.outside},     {"dimmed", dimmed}};
}

struct RunSeconds {
    double read = 0;
    double total = 0;
};

ordered_json reportOf(const ConvertJob& job, const ConvertOptions& options,
                      const MemoryPlan& memory, const Written& written, const std::string& remark,
                      RunSeconds seconds) {
    ordered_json report = reportOf(job, options);
    report["counts"] = countsOf(written.counts, written.dimmed);
    addEstimate(written.estimates, report);
    if (!remark.empty()) report["remark"] = remark;
    // Tiles are made while others are written: what remains beside reading and writing.
    report["time"] = {
        {"plan", job.planSeconds},
        {"read", seconds.read - job.found.seconds - job.planSeconds},
        {"align", job.found.seconds},
        {"reconstruct", std::max(0.0, seconds.total - seconds.read - written.writeSeconds)},
        {"write", written.writeSeconds},
        {"total", seconds.total}};
    report["peak_memory"] = peakMemory();
    report["scratch_bytes"] = memory.scratchBytes;
    if (written.resumedTiles > 0) report["resumed_tiles"] = written.resumedTiles;
    report["output"] = {{"path", options.output.string()},
                        {"bytes", written.bytes},
                        {"pixel", nameOf(written.type)}};
    return report;
}

}  // namespace

ordered_json convert(const ConvertOptions& options, const ProgressSink& progress) {
    const Stopwatch time;
    ConvertJob job = prepareConvert(options, progress);
    const ordered_json asked = askedOf(job, options);
    if (isFinished(options, asked, job.header.shard)) return finishedReport(job, options, time);
    const MemoryPlan memory = planMemory(job.memory, options.memory);
    if (job.isUnshifted) checkUnshiftedMemory(job, options);
    std::unique_ptr<TransposedTable> table;
    ReadStack aligned;
    if (job.isUnshifted) {
        aligned = readStack(job.input, job.samples(), job.texels, job.found.plane, progress);
    } else {
        table = tableFor(job, memory, options.output);
    }
    const ReadFacts facts =
        countedIn(job, table ? readTexels(job, memory, *table, progress) : aligned.facts);
    malloc_trim(0);
    const double readSeconds = time.seconds();

    const std::vector<std::size_t>& images = job.samples().pairs;
    MethodChoice method = job.method;
    method.options.alone = job.texels.count() == 1 && job.layout().kind != AtlasKind::kModel;
    const auto reconstructor =
        buildReconstructor(method, job.planned, job.input, images, facts, progress);
    malloc_trim(0);
    const std::string remark = reconstructor->remark();
    if (!remark.empty() && job.input.warn) job.input.warn(remark);
    const ordered_json identity =
        identityOf(asked, facts.hash, meanSamples(images, facts.means, job.samples()),
                   *reconstructor, job.grazing.inner().pairCount());
    job.header.job = jsonText(identity);
    const TexelMaker maker{
        TexelSlicer(images, job.samples()), *reconstructor, job.grazing,
        TexelFinisher(job.grid, {job.input.colors.transform("scene_linear", options.outputSpace),
                                 job.header.cosine == Cosine::kDivided}),
        job.grid.pairCount()};
    const ordered_json model = settleTolerance(job, options, *reconstructor, maker.slicer, facts);
    Written written;
    if (job.layout().kind == AtlasKind::kModel) {
        WrittenModel made =
            writeModel(job, options, *table, maker.slicer, *reconstructor, progress);
        written.counts = job.header.counts;
        written.type = made.type;
        written.bytes = made.bytes;
        written.estimates = std::move(made.estimates);
    } else if (table) {
        written = writeAtlas(job, options, memory, *table, maker, identity, progress);
    } else {
        const UnshiftedAtlas made = writeUnshifted(job, options, aligned.stack, maker, progress);
        written.counts = made.counts;
        written.dimmed = made.dimmed;
        written.type = made.type;
        written.bytes = made.bytes;
    }
    ordered_json report =
        reportOf(job, options, memory, written, remark, {readSeconds, time.seconds()});
    if (!model.is_null()) report["model"] = model;
    return report;
}

}  // namespace abrdf
