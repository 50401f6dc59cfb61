// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/grazing.h"
#include "pipeline/plane.h"
#include "pipeline/reconstruction.h"
#include "stages/write/atlas_writer.h"

#include <nlohmann/json.hpp>

namespace abrdf {

enum class PixelChoice {
    kAuto,  ///< Half where every value fits, else float.
    kHalf,
    kFloat,
};

/// The main job: a BTF stack in, an atlas of reconstructed ABRDFs out.
struct ConvertOptions {
    InputOptions input;
    std::filesystem::path output;
    MethodChoice method;
    std::string grid = "input";        ///< Or what gridFromName() takes.
    Grazing grazing = Grazing::kHold;  ///< Past the measured elevations.
    Texels texels;
    PlaneChoice plane;
    AtlasKind layout = AtlasKind::kAngular;
    PixelChoice pixel = PixelChoice::kAuto;
    Compression compression = Compression::kZip;
    std::string outputSpace = "scene_linear";
    bool divideCosine = false;
};

/// What a job would do, without decoding a pixel: images to be read, bytes, memory, output size.
nlohmann::ordered_json planConvert(const ConvertOptions& options);

/// Does the job; the output file appears whole or not at all. Returns the report of interface.md.
/// Throws std::runtime_error for faults of files, std::invalid_argument for impossible options.
nlohmann::ordered_json convert(const ConvertOptions& options, const ProgressSink& progress);

}  // namespace abrdf
