// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/train/train.h"

#include "abrdf/output_file.h"
#include "abrdf/pair_features.h"
#include "abrdf/stopwatch.h"
#include "pipeline/train/prior_cache.h"
#include "stages/slice/choose_samples.h"
#include "stages/train/model_file.h"

#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

nlohmann::ordered_json train(const TrainJob& job, const ProgressSink& progress,
                             const MessageSink& warn) {
    if (!job.output.empty()) checkOutputPath(job.output);
    const Stopwatch time;
    const AngularGrid measured = gridFromName(job.grid);
    const AngularGrid output = job.outputGrid.empty() ? measured : gridFromName(job.outputGrid);
    const Method& method = methodFromName("prior");
    const SamplePlan plan = planFor(method, job.plan, measured, {}, job.anywhere, progress, warn);
    const SampleSet samples =
        job.anywhere ? exactSamples(plan.samples) : chooseSamples(plan, measured, method.wish);
    const std::vector<LightAndView> outputs = distinctPairs(pairsOf(output)).distinct;
    fs::path file = job.output;
    if (file.empty()) {
        const auto folder = cacheFolder();
        if (!folder) {
            throw std::runtime_error(
                "neither XDG_CACHE_HOME nor HOME says where the cache is; name a file with -o");
        }
        priorFor(samples.directions, outputs, {{}, job.options}, progress, warn);
        file = cachedModel(*folder, samples.directions, outputs, job.options);
    } else {
        writeModel(file, trainedModel(samples.directions, outputs, job.options, progress));
    }
    return {{"command", "train"},
            {"version", ABRDF_VERSION},
            {"plan", {{"name", plan.name}, {"samples", samples.count()}}},
            {"grid", {{"lights", output.lights().size()}, {"views", output.views().size()}}},
            {"output", {{"path", file.string()}, {"bytes", fs::file_size(file)}}},
            {"time", time.seconds()}};
}

}  // namespace abrdf
