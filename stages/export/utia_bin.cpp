// SPDX-License-Identifier: BSD-3-Clause
//
// UTIA BRDF .bin: 288 x 288 little-endian doubles a plane, planes R G B; no header.
#include "abrdf/output_file.h"
#include "stages/export/utia_table.h"

#include <array>

namespace abrdf {

ExportReport writeUtiaBin(const std::filesystem::path& path, const ExportSource& source,
                          const ExportOptions& options) {
    UtiaTable table = utiaTable(source, options);
    std::vector<double> plane(table.values.size());
    OutputFile file(path);
    for (const auto channel : std::array{&Rgb::r, &Rgb::g, &Rgb::b}) {
        for (std::size_t i = 0; i < plane.size(); ++i) {
            plane[i] =
                utiaFromLinear(static_cast<double>(table.values[i].*channel), options.utiaEncoding);
        }
        file.write({reinterpret_cast<const char*>(plane.data()), plane.size() * sizeof(double)});
    }
    file.commit();
    table.report.details["layout"] = "288 x 288 little-endian doubles a plane; planes R G B";
    return table.report;
}

}  // namespace abrdf
