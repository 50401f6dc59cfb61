// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert.h"

#include "abrdf/scratch_file.h"
#include "abrdf/stopwatch.h"
#include "abrdf/transposed_table.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/convert_report.h"
#include "pipeline/convert/finished_atlas.h"
#include "pipeline/convert/job_identity.h"
#include "pipeline/convert/settle_tolerance.h"
#include "pipeline/convert/write_model.h"
#include "pipeline/convert/write_resumable.h"
#include "pipeline/convert/write_unshifted.h"
#include "pipeline/json_text.h"

#include <malloc.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

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

ReadFacts countedIn(ConvertJob& job, ReadFacts facts) {
    if (job.header.shard <= 1) {
        job.header.counts.nonfinite = facts.leftOut;
        job.header.counts.outside = facts.outside;
    }
    return facts;
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
    const WrittenAtlas written =
        job.isUnshifted ? writeUnshifted(job, options, aligned.stack, maker, progress)
        : job.layout().kind == AtlasKind::kModel
            ? writeModel(job, options, *table, maker.slicer, *reconstructor, progress)
            : writeResumable(job, options, memory, *table, maker, identity, progress);
    ordered_json report =
        reportOf(job, options, memory, written, remark, {readSeconds, time.seconds()});
    if (!model.is_null()) report["model"] = model;
    return report;
}

}  // namespace abrdf
