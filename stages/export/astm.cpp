// SPDX-License-Identifier: BSD-3-Clause
//
// ASTM E1392 text as Cornell's measurements and libbsdf's AstmReader take it: NUM_POINTS and VARS,
// then a row of angles in radians and the BRDF in 1/sr for each pair, with commas between.
#include "abrdf/output_file.h"
#include "stages/export/goniometer_table.h"

#include <fmt/format.h>

namespace abrdf {

ExportReport writeAstm(const std::filesystem::path& path, const ExportSource& source,
                       const ExportOptions& options) {
    const GoniometerTable table = goniometerTable(source, options);
    const std::size_t lightPhis = table.lightPhis.size();
    const std::size_t viewCount = table.viewThetas.size() * table.viewPhis.size();
    const std::size_t rows = table.lightThetas.size() * table.closedLightPhis() * viewCount;
    std::string text = fmt::format("NUM_POINTS {}\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n", rows);
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t tl = row / viewCount / table.closedLightPhis();
        const std::size_t pl = row / viewCount % table.closedLightPhis();
        const std::size_t i = (tl * lightPhis + pl % lightPhis) * viewCount + row % viewCount;
        const auto& [light, view] = table.pairAt(i);
        const auto& [r, g, b] = table.values[i];
        text += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6g},{:.6g},{:.6g}\n", light.theta,
                            pl < lightPhis ? light.phi : 2 * kPi, view.theta, view.phi, r, g, b);
    }
    writeWholeFile(path, text);
    return reportOf(table, options, "text: theta_i phi_i theta_s phi_s in radians, then R G B");
}

}  // namespace abrdf
