// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/export_brdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace abrdf {

namespace fs = std::filesystem;

// A new format is one file in this folder and one line in each of these two lists.
using WriteFormat = ExportReport(const fs::path& path, const ExportSource& source,
                                 const ExportOptions& options);
WriteFormat writeUtiaBin, writeUtiaExr, writeMerl, writeRgl, writeRadiance, writeAstm, writeSsdd;

namespace {

constexpr std::array kFormats{
    ExportFormat{"utia-bin", "UTIA BRDF: 288 x 288 doubles, three planes", writeUtiaBin},
    ExportFormat{"utia-exr", "UTIA BRDF: a 288 x 288 float OpenEXR image", writeUtiaExr},
    ExportFormat{"merl", "MERL .binary: the isotropic average", writeMerl},
    ExportFormat{"rgl", "RGL .bsdf tensor file", writeRgl},
    ExportFormat{"radiance", "Radiance BSDF: XML of tensor trees", writeRadiance},
    ExportFormat{"astm", "ASTM E1392 text: angles and BRDF, a row a pair", writeAstm},
    ExportFormat{"ssdd", "SSDD 0.2 text: lists of angles and the BRDF", writeSsdd},
};

}  // namespace

std::span<const ExportFormat> exportFormats() {
    return kFormats;
}

const ExportFormat& exportFormatFromName(const std::string& name) {
    const auto found =
        std::ranges::find_if(kFormats, [&](const ExportFormat& f) { return f.name == name; });
    if (found != kFormats.end()) return *found;
    std::string names;
    for (const ExportFormat& format : kFormats) names += fmt::format(" {}", format.name);
    throw std::invalid_argument(
        fmt::format("there is no format '{}' to export to; there are:{}", name, names));
}

}  // namespace abrdf
