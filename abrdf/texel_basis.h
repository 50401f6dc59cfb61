// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/matrix_product.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// What the texels of a material have in common: with x = centre + basis . vector for the
/// logarithms of luminance and channels, and for chroma (texelColors() says how they become
/// colours).
struct TexelBasis {
    PackedMatrix luminance;  ///< Row, column.
    PackedMatrix chroma;
    std::array<std::vector<float>, 4> logCenters;  ///< A number a row.
    std::array<std::vector<float>, 2> chromaCenters;

    std::size_t rows() const { return luminance.rows(); }

    /// The rows at these places, in their order.
    TexelBasis atRows(std::span<const std::size_t> places) const;

    /// Rows of the result are means over the rows of a group, of the first `columns` columns.
    /// groupOf: of each row its group, one of `groups`, none of which is empty.
    TexelBasis groupMeans(std::span<const std::size_t> groupOf, std::size_t groups,
                          std::size_t columns) const;
};

}  // namespace abrdf
