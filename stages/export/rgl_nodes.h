// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/rgl_table.h"
#include "stages/export/isotropy.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace abrdf {

/// How finely an RGL file is tabulated.
struct RglShape {
    bool isotropic = true;
    std::size_t phis = 1;       ///< Azimuths of w_i that differ.
    std::size_t warp = 0;       ///< Side of a table of visible normals.
    std::size_t side = 0;       ///< Side of a table of samples.
    Radians step = 0;           ///< Of the elevations of w_i, at most.
    std::vector<float> thetas;  ///< 0 .. pi/2.

    /// w_i of a table.
    Direction incident(std::size_t phi, std::size_t theta) const;
    std::size_t tables() const { return phis * thetas.size(); }
};

/// The density that samples are warped by, over u_m: warp x warp values for each w_i, of the
/// distribution `ndf` and its projected area `sigma`.
std::vector<float> sampleDensity(const RglShape& shape, const TableStack& ndf,
                                 const TableStack& sigma);

/// S, a table of side x side for each w_i.
struct RglNodes {
    std::vector<Rgb> values;
    std::vector<float> shares;  ///< What a sample counts in the energy: visible over its density.
    std::vector<std::uint8_t> places;  ///< 0 below the horizon, 1 above, 2 past what was measured.
};

/// `data` without colours: its warp, distribution and area. Throws as checkRange().
RglNodes nodesOf(const RglShape& shape, const RglData& data, const ExportSource& source,
                 const TurnedBrdf& brdf);

/// A reflectance that rounding and interpolation alone bring above 1 is brought back; one that is
/// above it in the source stays. Returns the largest, as written.
double keepEnergy(const RglShape& shape, RglNodes& nodes);

}  // namespace abrdf
