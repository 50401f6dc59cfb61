// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_layout.h"
#include "abrdf/grazing.h"
#include "abrdf/progress.h"
#include "pipeline/convert/convert.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace abrdf {

/// A model atlas in, one of all pairs out.
struct ExpandOptions {
    std::filesystem::path input;
    std::filesystem::path output;
    std::optional<std::filesystem::path> colorConfig;  ///< Else $OCIO, else the shipped config.
    std::string grid = "input";  ///< The model's own, or what gridFromName() takes.
    Grazing grazing = Grazing::kHold;
    AtlasKind layout = AtlasKind::kAngular;  ///< Angular or spatial.
    PixelChoice pixel = PixelChoice::kAuto;
    Compression compression = Compression::kZip;
    std::string outputSpace;  ///< Empty: the model's.
    bool divideCosine = false;
    std::uint64_t memory = std::uint64_t{2} << 30;  ///< Bound on the resident set, bytes.
};

/// Returns the report. Throws std::runtime_error for faults of files, std::invalid_argument for
/// impossible options. The output appears whole or not at all.
nlohmann::ordered_json expand(const ExpandOptions& options, const ProgressSink& progress);

}  // namespace abrdf
