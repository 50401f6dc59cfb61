// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/export/export_brdf.h"

#include <vector>

namespace abrdf {

/// The 288 x 288 colours of the UTIA BRDF grid, rows light, columns view, not yet encoded; and the
/// report of a file that holds them.
struct UtiaTable {
    std::vector<Rgb> values;
    ExportReport report;
};
UtiaTable utiaTable(const ExportSource& source, const ExportOptions& options);

}  // namespace abrdf
