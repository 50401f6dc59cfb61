// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/export/export_brdf.h"

namespace abrdf {

/// How a material differs from simpler ones that a format would take it for. Over the light at
/// azimuth 0 of six elevations up to `maxTheta`, 81 views and all turns, weighted by
/// cos(theta_v) sin(theta_v) sin(theta_i).
struct Symmetries {
    double turnDeltaE = 0;  ///< Mean CIE Delta E (1976) from the mean over turns of the sample.
    double turnShare = 0;   ///< Of the energy of f cos(theta_i): what that mean leaves out.
    double swapShare = 0;   ///< Of the energy of f: half of f(light, view) - f(view, light).
};
Symmetries symmetriesOf(const ExportSource& source, int azimuths);

/// The same for a report, and in sentences on what a file of path tracers loses by them.
nlohmann::ordered_json reportOf(const Symmetries& symmetries);
nlohmann::ordered_json notesOn(const Symmetries& symmetries, double tolerance);

/// The ABRDF as f cos(theta_i), and its mean over `azimuths` turns of the sample where that is
/// above 1; values that are not finite are left out. 1/sr.
class TurnedBrdf {
  public:
    TurnedBrdf(const ExportSource& source, int azimuths) : source_(source), azimuths_(azimuths) {}

    Rgb evaluate(const LightAndView& pair) const;

  private:
    const ExportSource& source_;
    int azimuths_;
};

/// The CIE Y of a linear Rec.709 colour.
inline double luminanceOf(Rgb c) {
    return 0.2126729 * static_cast<double>(c.r) + 0.7151522 * static_cast<double>(c.g) +
           0.0721750 * static_cast<double>(c.b);
}

}  // namespace abrdf
