// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "abrdf/cosine.h"
#include "color/rgb.h"

#include <cstddef>
#include <span>

namespace abrdf {

/// How far B(a, b) is from B(b, a), over all pairs of directions that stand in both lists.
struct Reciprocity {
    std::size_t pairs = 0;   ///< Compared, each once; 0: none can be.
    double rmsAsStored = 0;  ///< Root mean square of ln B(a, b) - ln B(b, a).
    double rmsDivided = 0;   ///< The same of B / cos(theta_i).
    double largest = 0;      ///< Of 2 |f(a, b) - f(b, a)| / (f(a, b) + f(b, a)), 0 .. 2.
    LightAndView where;      ///< The pair of the largest.
};

/// values: one a pair of the grid, NaN where unknown; channels are summed. `largest` is of the
/// values divided by cos(theta_i) where that is in them.
Reciprocity reciprocityOf(const AngularGrid& grid, std::span<const Rgb> values, Cosine cosine);

/// Whether the values look as if cos(theta_i) were in them: dividing by it makes them reciprocal.
/// fallback: where they do not tell (fewer than 10 pairs, or the two differ by less than a tenth).
Cosine cosineFromReciprocity(const Reciprocity& reciprocity, Cosine fallback);

}  // namespace abrdf
