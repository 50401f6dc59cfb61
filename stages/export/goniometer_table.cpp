// SPDX-License-Identifier: BSD-3-Clause
#include "stages/export/goniometer_table.h"

#include "abrdf/for_each_texel.h"
#include "stages/export/value_range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace abrdf {

namespace {

/// 0, step, 2 step ... below `end`.
std::vector<double> anglesUpTo(double end, double step) {
    std::vector<double> angles;
    for (int k = 0; step * k < end; ++k) angles.push_back(step * k);
    return angles;
}

constexpr double kPastLast = 81;  ///< Past the last elevation, degrees.

}  // namespace

LightAndView GoniometerTable::pairAt(std::size_t index) const {
    const auto next = [&](const std::vector<double>& angles) {
        const double angle = angles[index % angles.size()];
        index /= angles.size();
        return radiansFromDegrees(angle);
    };
    LightAndView pair;
    pair.view.phi = next(viewPhis);
    pair.view.theta = next(viewThetas);
    pair.light.phi = next(lightPhis);
    pair.light.theta = next(lightThetas);
    return pair;
}

GoniometerTable goniometerTable(const ExportSource& source, const ExportOptions& options) {
    GoniometerTable table;
    table.symmetries = symmetriesOf(source, options.azimuths);
    table.isotropic = table.symmetries.turnDeltaE <= options.tolerance;
    table.lightThetas = anglesUpTo(kPastLast, table.isotropic ? 5 : 15);
    table.lightPhis = table.isotropic ? std::vector<double>{0} : anglesUpTo(360, 15);
    table.viewThetas = anglesUpTo(kPastLast, 5);
    table.viewPhis = anglesUpTo(360, table.isotropic ? 5 : 15);
    table.values.resize(table.lightThetas.size() * table.lightPhis.size() *
                        table.viewThetas.size() * table.viewPhis.size());
    const TurnedBrdf brdf(source, table.isotropic ? options.azimuths : 1);
    forEachTexelBlock(table.values.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const LightAndView pair = table.pairAt(i);
            table.values[i] =
                static_cast<float>(1 / std::cos(pair.light.theta)) * brdf.evaluate(pair);
        }
    });
    checkRange(table.values, source);
    for (std::size_t i = 0; i < table.values.size(); ++i) {
        table.extrapolated.push_back(source.brdf.isExtrapolated(table.pairAt(i)));
    }
    return table;
}

ExportReport reportOf(const GoniometerTable& table, const ExportOptions& options,
                      const char* layout) {
    ExportReport report;
    report.values = table.values.size();
    report.extrapolated = static_cast<std::uint64_t>(std::ranges::count(table.extrapolated, true));
    report.details = {{"layout", layout},
                      {"value", "BRDF, 1/sr, linear Rec.709"},
                      {"isotropic", table.isotropic},
                      {"symmetry", reportOf(table.symmetries)},
                      {"notes", notesOn(table.symmetries, options.tolerance)}};
    return report;
}

}  // namespace abrdf
