// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/plan/plan.h"

#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "pipeline/plan/plan_report.h"
#include "pipeline/plan/planned_samples.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

ordered_json plan(const PlanJob& job, const ProgressSink& progress) {
    if (job.samples < 1 || job.samples > 5000) {
        throw std::invalid_argument(
            fmt::format("--samples {} is not possible: choose 1 to 5000", job.samples));
    }
    if (!(job.travel >= 0 && job.travel <= 1e6)) {
        throw std::invalid_argument("--travel is a number of samples, 0 or more");
    }
    checkOutputPath(job.output);
    const Stopwatch time;
    const PlannedSamples planned = planSamples(job, progress);
    writeWholeFile(job.output, planFileText(planned));
    ordered_json report = reportOf(planned);
    report["output"] = {{"path", job.output.string()},
                        {"bytes", std::filesystem::file_size(job.output)}};
    report["time"] = time.seconds();
    return report;
}

}  // namespace abrdf
