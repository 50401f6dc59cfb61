// SPDX-License-Identifier: BSD-3-Clause
//
// ASTM E1392 text: header lines, then a row of angles in radians and the BRDF in 1/sr for each
// pair, as the viewers of optics (libbsdf's BSDF Viewer) read it.
#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "stages/export/isotropy.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace abrdf {

namespace {

std::vector<LightAndView> pairsFor(bool isotropic) {
    const int lightThetas = isotropic ? 17 : 6;
    const int lightPhis = isotropic ? 1 : 24;
    const int viewPhis = isotropic ? 72 : 24;
    constexpr int kViewThetas = 17;
    const auto angle = [](double step, int k) { return radiansFromDegrees(step * k); };
    std::vector<LightAndView> pairs;
    for (int ti = 0; ti < lightThetas; ++ti) {
        for (int pi = 0; pi < lightPhis; ++pi) {
            for (int tv = 0; tv < kViewThetas; ++tv) {
                for (int pv = 0; pv < viewPhis; ++pv) {
                    pairs.push_back({{angle(isotropic ? 5 : 15, ti), angle(15, pi)},
                                     {angle(5, tv), angle(360.0 / viewPhis, pv)}});
                }
            }
        }
    }
    return pairs;
}

}  // namespace

ExportReport writeAstm(const std::filesystem::path& path, const ExportSource& source,
                       const ExportOptions& options) {
    const Symmetries symmetries = symmetriesOf(source, options.azimuths);
    const bool isotropic = symmetries.turnDeltaE <= options.tolerance;
    const TurnedBrdf brdf(source, isotropic ? options.azimuths : 1);
    const std::vector<LightAndView> pairs = pairsFor(isotropic);
    std::vector<Rgb> values(pairs.size());
    forEachTexelBlock(pairs.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto scale = static_cast<float>(1 / std::cos(pairs[i].light.theta));
            values[i] = scale * brdf.evaluate(pairs[i]);
        }
    });
    std::string text =
        fmt::format("NUM_POINTS {}\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\n", pairs.size());
    ExportReport report;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& [light, view] = pairs[i];
        const auto& [r, g, b] = values[i];
        text += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6g},{:.6g},{:.6g}\n", light.theta,
                            light.phi, view.theta, view.phi, r, g, b);
        report.extrapolated += source.brdf.isExtrapolated(pairs[i]) ? 1U : 0U;
    }
    writeWholeFile(path, text);
    report.values = pairs.size();
    report.details = {{"layout", "text: theta_i phi_i theta_s phi_s in radians, then R G B"},
                      {"value", "BRDF, 1/sr, linear Rec.709"},
                      {"isotropic", isotropic},
                      {"symmetry", reportOf(symmetries)},
                      {"notes", notesOn(symmetries, options.tolerance)}};
    return report;
}

}  // namespace abrdf
