// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/dry_run.h"

#include "abrdf/scratch_file.h"
#include "pipeline/convert/convert_job.h"
#include "pipeline/convert/convert_report.h"

#include <cstdint>
#include <string>
#include <vector>

namespace abrdf {

using nlohmann::ordered_json;

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
        {"output_bytes_uncompressed", 3 * bytesOf(firstType(options.pixel)) * values}};
    report["images"] = files;
    return report;
}

}  // namespace abrdf
