// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/job.h"
#include "stages/export/export_brdf.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// An atlas, or any database, into another program's format: one ABRDF, the mean over all texels.
struct ExportJob {
    InputOptions input;
    std::string format;  ///< One of exportFormats().
    std::filesystem::path output;
    Grazing grazing = Grazing::kHold;
    ExportOptions options;
};

/// Writes the file, and FILE.json beside it: what it is, where it comes from, what was extrapolated
/// and what was lost. Returns the same. Throws as convert().
nlohmann::ordered_json exportBrdf(const ExportJob& job, const ProgressSink& progress);

}  // namespace abrdf
