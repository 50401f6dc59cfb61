// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report.h"

#include "stages/read/atlas_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json reportFolder(const fs::path& folder, PageOptions options,
                          const ProgressSink& progress) {
    if (!fs::is_directory(folder)) {
        throw std::runtime_error(
            fmt::format("{}: is no folder; name one that holds atlases (.exr) or reports (.json)",
                        folder.string()));
    }
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    for (const fs::path& file : files) {
        if (file.extension() == ".exr" && isAtlas(file)) options.atlases.push_back(file);
        if (file.extension() == ".json") options.reports.push_back(file);
    }
    if (options.atlases.empty() && options.reports.empty()) {
        throw std::runtime_error(
            fmt::format("{}: holds neither an atlas (.exr) nor a report (.json)", folder.string()));
    }
    if (options.title.empty()) {
        options.title = fs::weakly_canonical(folder).filename().string();
    }
    ordered_json report;
    report["command"] = "report";
    report.update(writePage(options, progress));
    return report;
}

}  // namespace abrdf
