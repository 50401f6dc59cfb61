// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/grazing_brdf.h"
#include "abrdf/utia_encoding.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace abrdf {

/// One texel's ABRDF, known at any pair, on its way into another program's format.
struct ExportSource {
    const GrazingBrdf& brdf;  ///< Linear Rec.709.
    Cosine cosine = Cosine::kKept;
    std::string name;        ///< What it comes from, for headers: a file's own name.
    bool isSampled = false;  ///< Interpolated between the directions of a grid; else a table with
                             ///< more in it.
};

struct ExportOptions {
    UtiaEncoding utiaEncoding = UtiaEncoding::kLinear;  ///< Of utia-bin and utia-exr.
    int azimuths = 12;  ///< Turns of the sample that an isotropic average is taken over, 1 .. 360.
    double tolerance = 1;  ///< Of rgl and radiance: mean Delta E between a material's turns up to
                           ///< which it is isotropic; >= 0.
    double cull = 90;      ///< Of radiance: percent of a tree's leaves that go, 0 .. 100.
    bool spectra = false;  ///< Of rgl: smooth spectra beside RGB.
    int resolution =
        0;  ///< Of radiance: cells a side, a power of two. Of rgl: samples a side for each
            ///< direction, 8 .. 512; 0: 128 where an isotropic table, 64 where sampled, else 32.
};

/// What a format's file says, for the JSON beside it.
struct ExportReport {
    std::uint64_t values = 0;        ///< Colours written.
    std::uint64_t extrapolated = 0;  ///< Of these, past the measured elevations.
    nlohmann::ordered_json details;  ///< The layout in words, and what was lost.
};

/// A format that can be written: one file of this folder.
struct ExportFormat {
    const char* name;
    const char* description;  ///< One line.
    ExportReport (*write)(const std::filesystem::path& path, const ExportSource& source,
                          const ExportOptions& options);
};

std::span<const ExportFormat> exportFormats();

/// Throws std::invalid_argument for an unknown name, listing the known ones.
const ExportFormat& exportFormatFromName(const std::string& name);

}  // namespace abrdf
