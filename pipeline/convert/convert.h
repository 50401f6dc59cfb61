// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/grazing.h"
#include "pipeline/chart/method_limits.h"
#include "pipeline/convert/pixel_choice.h"
#include "pipeline/convert/plane.h"
#include "pipeline/convert/shard.h"
#include "pipeline/reconstruction.h"
#include "stages/write/atlas_writer.h"

#include <nlohmann/json.hpp>

namespace abrdf {

/// The main job: a BTF stack in, an atlas of reconstructed ABRDFs out.
struct ConvertOptions {
    InputOptions input;
    std::filesystem::path output;
    MethodChoice method;
    MethodLimits limits;               ///< By which method, plan and rank are chosen.
    std::string grid = "input";        ///< Or what gridFromName() takes.
    std::filesystem::path pairs;       ///< What a scene shows, as CSV; empty: all of the grid.
    Grazing grazing = Grazing::kHold;  ///< Past the measured elevations.
    Texels texels;
    PlaneChoice plane;
    AtlasKind layout = AtlasKind::kAngular;
    PixelChoice pixel = PixelChoice::kAuto;
    Compression compression = Compression::kZip;
    std::string outputSpace = "scene_linear";
    bool divideCosine = false;
    std::uint64_t memory = std::uint64_t{2} << 30;  ///< Bound on the resident set, bytes.
    bool resume = false;  ///< Continue what an earlier run left, and leave what can be continued.
    /// A part of the atlas: some rows of texels, always in angular layout; merge() joins them.
    Shard shard;
};

/// Does the job; the output file appears whole or not at all. Returns the report of interface.md.
/// Throws std::runtime_error for faults of files, std::invalid_argument for impossible options.
nlohmann::ordered_json convert(const ConvertOptions& options, const ProgressSink& progress);

}  // namespace abrdf
