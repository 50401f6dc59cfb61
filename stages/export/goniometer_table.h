// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/export/export_brdf.h"
#include "stages/export/isotropy.h"

#include <vector>

namespace abrdf {

/// The BRDF at the angles of a goniometer, as the viewers of optics show it.
struct GoniometerTable {
    std::vector<double> lightThetas;  ///< Degrees, ascending, as are the others.
    std::vector<double> lightPhis;    ///< 0 alone where isotropic, else 0 .. below 360.
    std::vector<double> viewThetas;
    std::vector<double> viewPhis;  ///< 0 .. below 360.
    std::vector<Rgb> values;       ///< 1/sr, linear Rec.709; the last angle the fastest.
    std::vector<bool> extrapolated;
    bool isotropic = true;
    Symmetries symmetries;

    /// Azimuths of the light once round: the last is the first again, as readers would go on past
    /// the last one and not round. One where isotropic.
    std::size_t closedLightPhis() const { return isotropic ? 1 : lightPhis.size() + 1; }

    /// Angles by their places in the lists.
    std::size_t indexOf(std::size_t lightTheta, std::size_t lightPhi, std::size_t viewTheta,
                        std::size_t viewPhi) const {
        return ((lightTheta * lightPhis.size() + lightPhi) * viewThetas.size() + viewTheta) *
                   viewPhis.size() +
               viewPhi;
    }
    LightAndView pairAt(std::size_t index) const;
};

/// 5 degrees where the material is isotropic within options.tolerance, else 15 for the light and
/// the azimuths; elevations up to 80 degrees. Throws as checkRange().
GoniometerTable goniometerTable(const ExportSource& source, const ExportOptions& options);

/// The report of a file that holds the table.
ExportReport reportOf(const GoniometerTable& table, const ExportOptions& options,
                      const char* layout);

}  // namespace abrdf
