// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/write_resumable.h"

#include "abrdf/scratch_file.h"
#include "abrdf/stopwatch.h"
#include "pipeline/convert/tile_journal.h"
#include "pipeline/convert/write_atlas.h"

#include <fmt/format.h>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

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

}  // namespace

WrittenAtlas writeResumable(const ConvertJob& job, const ConvertOptions& options,
                            const MemoryPlan& memory, const TransposedTable& table,
                            const TexelMaker& maker, const ordered_json& identity,
                            const ProgressSink& progress) {
    ordered_json journalled = identity;
    if (job.header.shard > 0) {
        journalled["shard"] = fmt::format("{}/{}", job.header.shard, job.header.shards);
    }
    const bool hasEstimate = maker.reconstructor.knowsError();
    if (hasEstimate) journalled["estimate"] = true;
    TileJournal journal(options.output, journalled, firstType(options.pixel), options.resume);
    UnfinishedAtlas unfinished(journal, options.resume);
    WrittenAtlas written;
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

}  // namespace abrdf
