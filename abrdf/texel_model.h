// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "abrdf/texel_basis.h"
#include "abrdf/texel_codes.h"
#include "abrdf/texel_colors.h"
#include "color/rgb.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// A material's ABRDFs as few numbers a texel and a basis that all texels share. A texel of rank r
/// has r numbers a vector, for the first r columns of the basis for small ranks, or all columns of
/// the whole one. From any thread.
class TexelModel {
  public:
    TexelModel() = default;

    /// rowOf: of each pair, its row of the basis; pairs: its directions.
    TexelModel(TexelBasis basis, TexelRule rule, std::vector<std::size_t> rowOf,
               std::span<const LightAndView> pairs);

    /// Lets codes be of ranks below columns() as well, up to the columns of `small`: the best for
    /// each rank first.
    void addSmall(TexelBasis small);

    const TexelBasis& basis() const { return whole_.basis; }
    const TexelBasis* small() const { return small_ ? &small_->basis : nullptr; }
    bool hasIsotropic() const { return isotropic_.has_value(); }
    const TexelRule& rule() const { return rule_; }
    const std::vector<std::size_t>& rowOf() const { return whole_.rowOf; }
    std::size_t pairs() const { return whole_.rowOf.size(); }
    std::size_t columns() const { return whole_.basis.luminance.columns(); }

    /// Lets codes be of kIsotropicRank: means of the rows for small ranks.
    void addIsotropic(std::span<const LightAndView> pairs);

    /// The same for these pairs alone, in their order.
    TexelModel restricted(std::span<const std::size_t> pairs) const;

    /// All pairs of each texel, texel after texel. A texel's do not depend on the others.
    void evaluate(const TexelCodes& codes, std::span<Rgb> abrdfs) const;

    /// One value, with the bits of evaluate().
    Rgb at(const TexelCodes& codes, std::size_t texel, std::size_t pair) const;

    /// Of a texel of this rank.
    double multiplyAdds(std::size_t rank) const;
    /// Of a texel of this rank as floats.
    double bytes(std::size_t rank) const;

  private:
    struct Part {
        TexelBasis basis;
        std::vector<std::size_t> rowOf;  ///< Of each pair.
        bool rowsArePairs = false;       ///< Is rowOf[i] = i for all?
    };
    struct Products;
    static Part partOf(TexelBasis basis, std::vector<std::size_t> rowOf);
    static Part restricted(const Part& part, std::span<const std::size_t> pairs);
    const Part& partOf(std::size_t rank) const;
    static void multiply(const Part& part, std::span<const std::span<const float>, 6> vectors,
                         std::size_t rank, std::size_t firstPanel, Products& products);
    void evaluate(const Part& part, const TexelCodes& codes, std::span<const std::size_t> texels,
                  std::size_t rank, std::span<Rgb> abrdfs) const;
    TexelRows rowsOf(const Part& part, const TexelScale& scale, std::size_t firstRow) const;

    TexelRule rule_;
    Part whole_;
    std::optional<Part> small_;
    std::optional<Part> isotropic_;
    std::vector<float> cosines_;  ///< cos(theta_i) of each pair.
};

}  // namespace abrdf
