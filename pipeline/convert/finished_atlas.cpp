// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/finished_atlas.h"

#include "abrdf/output_file.h"
#include "pipeline/convert/convert_report.h"
#include "pipeline/convert/estimate_report.h"
#include "pipeline/convert/tile_journal.h"
#include "pipeline/process_memory.h"
#include "stages/read/atlas_reader.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

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

}  // namespace abrdf
