// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/utia_table.h"

#include "abrdf/for_each_texel.h"

namespace abrdf {

UtiaTable utiaTable(const ExportSource& source, const ExportOptions& options) {
    const AngularGrid grid(regularDirections(6, 48));
    UtiaTable table;
    table.values.resize(grid.pairCount());
    forEachTexelBlock(grid.pairCount(), 288, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            table.values[i] = source.brdf.evaluate(grid.pair(i));
        }
    });
    table.report.values = grid.pairCount();
    for (const LightAndView& pair : pairsOf(grid)) {
        table.report.extrapolated += source.brdf.isExtrapolated(pair) ? 1U : 0U;
    }
    table.report.details = {
        {"grid", "utia288: theta 0, 15 .. 75 degrees by 48 azimuths of 7.5"},
        {"order", "rows light, columns view; index = 48 ring + azimuth"},
        {"encoding", nameOf(options.utiaEncoding)},
        {"value", source.cosine == Cosine::kKept ? "reflectance factor times cos(theta_i)"
                                                 : "reflectance factor"}};
    return table;
}

}  // namespace abrdf
