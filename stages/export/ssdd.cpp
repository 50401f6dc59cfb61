// SPDX-License-Identifier: BSD-3-Clause
//
// Surface scattering distribution data 0.2, ASCII [libbsdf, doc/SsddFileFormatSpecification.md]:
// lists of angles in degrees, then the BRDF in 1/sr, the elevation of the light the fastest.
#include "abrdf/output_file.h"
#include "stages/export/goniometer_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace abrdf {

namespace {

/// On one line, and without a '#', which would begin a comment.
std::string oneLine(std::string name) {
    for (char& c : name) {
        if (c == '#' || static_cast<unsigned char>(c) < ' ') c = '_';
    }
    return name;
}

/// Azimuths once round: the last is the first again.
std::vector<double> closed(std::vector<double> phis) {
    phis.push_back(360);
    return phis;
}

std::string headerOf(const GoniometerTable& table, const std::string& name) {
    std::string text =
        "VERSION 0.2\nSOFTWARE abrdf\n\nDATA_TYPE brdf\nCOLOR_MODEL rgb\n"
        "PARAM_TYPE spherical_coordinate_system\n";
    text += fmt::format("PARAM0_LIST {:g}\n", fmt::join(table.lightThetas, " "));
    if (!table.isotropic) {
        text += fmt::format("PARAM1_LIST {:g}\n", fmt::join(closed(table.lightPhis), " "));
    }
    text += fmt::format("PARAM2_LIST {:g}\n", fmt::join(table.viewThetas, " "));
    text += fmt::format("PARAM3_LIST {:g}\n", fmt::join(closed(table.viewPhis), " "));
    return text + fmt::format("NAME {}\nSOURCE_TYPE measured\nDATA ascii\n", oneLine(name));
}

}  // namespace

ExportReport writeSsdd(const std::filesystem::path& path, const ExportSource& source,
                       const ExportOptions& options) {
    const GoniometerTable table = goniometerTable(source, options);
    std::string text = headerOf(table, source.name);
    const std::size_t lightPhis = table.lightPhis.size();
    const std::size_t viewPhis = table.viewPhis.size();
    for (std::size_t pv = 0; pv <= viewPhis; ++pv) {
        for (std::size_t tv = 0; tv < table.viewThetas.size(); ++tv) {
            for (std::size_t pl = 0; pl < table.closedLightPhis(); ++pl) {
                for (std::size_t tl = 0; tl < table.lightThetas.size(); ++tl) {
                    const auto& [r, g, b] =
                        table.values[table.indexOf(tl, pl % lightPhis, tv, pv % viewPhis)];
                    text += fmt::format("{:.6g} {:.6g} {:.6g}\n", r, g, b);
                }
            }
        }
    }
    writeWholeFile(path, text);
    return reportOf(table, options, "SSDD 0.2, ASCII: spherical coordinates in degrees, RGB");
}

}  // namespace abrdf
