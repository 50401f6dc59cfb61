// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/job.h"
#include "stages/export/export_brdf.h"

#include <nlohmann/json.hpp>

#include <optional>

namespace abrdf {

/// A texel of a map, counted from its top left corner.
struct TexelPlace {
    int x = 0;
    int y = 0;
};

/// "X,Y". Throws std::invalid_argument.
TexelPlace texelPlaceFromName(const std::string& name);

/// An atlas, or any database, into another program's format: one ABRDF, the mean over all texels or
/// one of them.
struct ExportJob {
    InputOptions input;
    std::string format;  ///< One of exportFormats().
    std::filesystem::path output;
    Grazing grazing = Grazing::kHold;
    ExportOptions options;
    std::optional<TexelPlace> texel;  ///< Nothing: the mean.
};

/// Writes the file, and FILE.json beside it: what it is, where it comes from, what was extrapolated
/// and what was lost. Returns the same. Throws as convert().
nlohmann::ordered_json exportBrdf(const ExportJob& job, const ProgressSink& progress);

}  // namespace abrdf
