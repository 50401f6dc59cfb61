// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/matrix_product.h"
#include "abrdf/texel_codes.h"

#include <Eigen/Core>

#include <cstddef>

namespace abrdf {

/// From whole codes, a number a sample, to fewer numbers (the projection of a NestedBasis).
class CodeProjection {
  public:
    /// There is none: codes stay whole.
    CodeProjection() = default;

    /// luminance, chroma: number, sample; chroma has as many rows. stride: of the projected codes,
    /// at least that many.
    CodeProjection(const Eigen::MatrixXf& luminance, const Eigen::MatrixXf& chroma, TexelRule rule,
                   std::size_t stride);

    bool isNone() const { return luminance_.columns() == 0; }

    /// Of the largest rank, all with the scales that they had.
    TexelCodes projected(const TexelCodes& whole) const;

    /// Of a texel.
    double multiplyAdds() const;

  private:
    PackedMatrix luminance_;
    PackedMatrix chroma_;
    TexelRule rule_;
    std::size_t stride_ = 0;
};

/// Sets the numbers past each texel's rank to 0; texels of whole rank get all of their numbers.
/// whole, projected: codes of the same texels.
void cutToRanks(const TexelCodes& whole, TexelCodes& projected);

/// Codes of one number, 0, for texels that all are the centre: a model of it alone takes them.
/// Throws std::logic_error where one differs by more than rounding.
TexelCodes codesOfCenter(const TexelCodes& whole, const TexelRule& rule);

}  // namespace abrdf
