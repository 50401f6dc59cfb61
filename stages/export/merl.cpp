// SPDX-License-Identifier: BSD-3-Clause
//
// MERL .binary [Matusik et al. 2003]: the isotropic, reciprocal average of an ABRDF.
#include "abrdf/for_each_texel.h"
#include "abrdf/merl_table.h"
#include "abrdf/output_file.h"
#include "stages/export/export_brdf.h"
#include "stages/export/turned_pair.h"

#include <array>
#include <cmath>
#include <vector>

namespace abrdf {

namespace {

/// What one entry holds and what its average lost.
struct Entry {
    std::array<double, 3> mean{};  ///< BRDF, 1/sr.
    bool isAbove = false;          ///< Both directions above the surface.
    bool isExtrapolated = false;
    double weight = 0;    ///< cos(theta_i) cos(theta_v) times the entry's measure.
    double square = 0;    ///< Mean over channels and turns of f^2.
    double variance = 0;  ///< Of that, what the mean leaves out.
};

/// The average over turns of the sample and both ways of the light.
Entry entryAt(std::size_t index, const ExportSource& source, int azimuths) {
    const HalfAngles angles = merl::anglesOfEntry(index);
    const LightAndView pair = pairFromHalfAngles(angles);
    Entry entry;
    entry.isAbove = pair.light.theta < kPi / 2 && pair.view.theta < kPi / 2;
    if (!entry.isAbove) return entry;
    entry.isExtrapolated = source.brdf.isExtrapolated(pair);
    const bool hasCosine = source.cosine == Cosine::kKept;
    std::array<double, 3> squares{};
    double count = 0;
    for (int k = 0; k < azimuths; ++k) {
        const LightAndView there = turnedPair(pair, 2 * kPi * k / azimuths);
        for (const LightAndView& way : {there, LightAndView{there.view, there.light}}) {
            const Rgb value = source.brdf.evaluate(way);
            if (!isFinite(value)) continue;
            const double scale = 1 / (kPi * (hasCosine ? std::cos(way.light.theta) : 1));
            const std::array<float, 3> channels = {value.r, value.g, value.b};
            for (std::size_t c = 0; c < 3; ++c) {
                const double f = scale * static_cast<double>(channels[c]);
                entry.mean[c] += f;
                squares[c] += f * f;
            }
            ++count;
        }
    }
    entry.isAbove = count > 0;
    if (!entry.isAbove) return entry;
    for (std::size_t c = 0; c < 3; ++c) {
        entry.mean[c] /= count;
        entry.square += squares[c] / count / 3;
        entry.variance += (squares[c] / count - entry.mean[c] * entry.mean[c]) / 3;
    }
    // d omega_i d omega_v = 4 cos(theta_d) d omega_h d omega_d; theta_h in square-root steps.
    entry.weight = std::cos(pair.light.theta) * std::cos(pair.view.theta) *
                   std::cos(angles.thetaDifference) * std::sin(angles.thetaDifference) *
                   std::sin(angles.thetaHalf) * std::sqrt(angles.thetaHalf);
    return entry;
}

}  // namespace

ExportReport writeMerl(const std::filesystem::path& path, const ExportSource& source,
                       const ExportOptions& options) {
    std::vector<Entry> entries(merl::kEntries);
    forEachTexelBlock(entries.size(), merl::kPhiDifference,
                      [&](std::size_t begin, std::size_t end) {
                          for (std::size_t i = begin; i < end; ++i) {
                              entries[i] = entryAt(i, source, options.azimuths);
                          }
                      });
    OutputFile file(path);
    const std::array<std::int32_t, 3> sizes = {merl::kThetaHalf, merl::kThetaDifference,
                                               merl::kPhiDifference};
    file.write({reinterpret_cast<const char*>(sizes.data()), sizeof sizes});
    std::vector<double> plane(entries.size());
    for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < entries.size(); ++i) {
            plane[i] = entries[i].isAbove ? entries[i].mean[c] / merl::kScales[c] : -1;
        }
        file.write({reinterpret_cast<const char*>(plane.data()), plane.size() * sizeof(double)});
    }
    file.commit();
    ExportReport report;
    double weights = 0;
    double squares = 0;
    double variances = 0;
    for (const Entry& entry : entries) {
        report.values += entry.isAbove ? 1U : 0U;
        report.extrapolated += entry.isAbove && entry.isExtrapolated ? 1U : 0U;
        weights += entry.weight;
        squares += entry.weight * entry.square;
        variances += entry.weight * std::max(0.0, entry.variance);
    }
    report.details = {
        {"layout", "int32 90 90 180, then doubles theta_h x theta_d x phi_d a plane; planes R G B"},
        {"value", "BRDF over 1/1500, 1.15/1500, 1.66/1500; -1 where there is no data"},
        {"lost",
         {{"rms_over_azimuth", weights > 0 ? std::sqrt(variances / weights) : 0},
          {"rms_of_brdf", weights > 0 ? std::sqrt(squares / weights) : 0},
          {"share_of_energy", squares > 0 ? variances / squares : 0}}}};
    return report;
}

}  // namespace abrdf
