// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// Directions of equal theta, evenly spread from phi0: what the page's shader interpolates among.
struct PageRing {
    double theta = 0;
    double phi0 = 0;
    int count = 0;
    int first = 0;  ///< Index of its first direction in the table.
};

/// One texel's ABRDF for the page.
struct PageTable {
    std::vector<PageRing> lightRings;
    std::vector<PageRing> viewRings;
    int lights = 0;
    int views = 0;
    bool cosineInside = true;           ///< cos(theta_i) is in the values.
    std::vector<double> lobe;           ///< LobeProfile::logarithms().
    std::vector<std::uint16_t> halves;  ///< [light][view][R, G, B], bits of half floats.
    bool resampled = false;             ///< The atlas's own directions form no even rings.
};

/// The rings of a list of directions and, for each place in the table, the index of its direction
/// in the list; nothing where they form no evenly spread rings (to a tenth of a degree).
struct EvenRings {
    std::vector<PageRing> rings;
    std::vector<std::size_t> order;
};
std::optional<EvenRings> evenRings(const std::vector<Direction>& directions);

/// The table of an atlas of one texel, linear Rec.709. Lists that form no even rings are resampled
/// onto 11 x 48 directions. Values are bounded to those of half floats; NaN becomes 0.
PageTable pageTableOf(const Atlas& atlas);

}  // namespace abrdf
