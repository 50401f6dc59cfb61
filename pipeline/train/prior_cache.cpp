// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/train/prior_cache.h"

#include "pipeline/train/error_scale.h"
#include "stages/train/model_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

namespace {

bool areSame(const std::vector<LightAndView>& a, const std::vector<LightAndView>& b) {
    if (a.size() != b.size()) return false;
    constexpr double kClose = 1e-10;  // Squared distance on both spheres.
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (squaredDistance(a[i], b[i]) > kClose) return false;
    }
    return true;
}

std::shared_ptr<const PriorModel> namedModel(const fs::path& file,
                                             const std::vector<LightAndView>& samples,
                                             const std::vector<LightAndView>& outputs) {
    auto model = std::make_shared<PriorModel>(readModel(file));
    if (!areSame(model->samples, samples)) {
        throw std::runtime_error(fmt::format(
            "{}: was trained for {} samples of another plan than this job's {}; give the same plan "
            "and input, or train one with abrdf train",
            file.string(), model->samples.size(), samples.size()));
    }
    if (!areSame(model->outputs, outputs)) {
        throw std::runtime_error(
            fmt::format("{}: was trained for another grid than this job's; give the same --grid, "
                        "or train one with abrdf train",
                        file.string()));
    }
    return model;
}

}  // namespace

std::optional<fs::path> cacheFolder() {
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
        return fs::path(cache) / "abrdf";
    }
    if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
        return fs::path(home) / ".cache" / "abrdf";
    }
    return {};
}

PriorModel trainedModel(const std::vector<LightAndView>& samples,
                        const std::vector<LightAndView>& outputs, const TrainOptions& options,
                        const ProgressSink& progress) {
    PriorModel model = trainPrior(samples, outputs, options, progress);
    model.errorScale = learnErrorScale(model, 1);
    return model;
}

fs::path cachedModel(const fs::path& folder, const std::vector<LightAndView>& samples,
                     const std::vector<LightAndView>& outputs, const TrainOptions& options) {
    return folder / fmt::format("prior-{:016x}", modelKey(samples, outputs, options));
}

std::shared_ptr<const PriorModel> priorFor(const std::vector<LightAndView>& samples,
                                           const std::vector<LightAndView>& outputs,
                                           const PriorSource& source, const ProgressSink& progress,
                                           const MessageSink& warn) {
    if (source.file) return namedModel(*source.file, samples, outputs);
    const std::optional<fs::path> folder = cacheFolder();
    fs::path file;
    if (folder) {
        file = cachedModel(*folder, samples, outputs, source.train);
        try {
            if (fs::exists(file)) {
                auto model = std::make_shared<PriorModel>(readModel(file));
                if (areSame(model->samples, samples) && areSame(model->outputs, outputs)) {
                    return model;
                }
            }
        } catch (const std::runtime_error& error) {
            if (warn) warn(fmt::format("{} (training it again)", error.what()));
        }
    }
    auto model =
        std::make_shared<PriorModel>(trainedModel(samples, outputs, source.train, progress));
    if (folder) {
        try {
            fs::create_directories(*folder);
            writeModel(file, *model);
        } catch (const std::runtime_error& error) {
            if (warn) warn(fmt::format("the trained model is not kept: {}", error.what()));
        }
    }
    return model;
}

}  // namespace abrdf
