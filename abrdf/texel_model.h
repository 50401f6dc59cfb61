// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/direction.h"
#include "abrdf/matrix_product.h"
#include "abrdf/texel_colors.h"
#include "color/rgb.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace abrdf {

/// Ranks that stand for more than how many numbers a vector has.
inline constexpr std::uint16_t kConstantRank = 0;   ///< Lambert's law: TexelScale::channel times
                                                    ///< cos(theta_i).
inline constexpr std::uint16_t kIsotropicRank = 2;  ///< The same for all isotropic twins.

/// One texel's numbers beside its vectors.
struct TexelScale {
    float luminance = 0;                ///< Scale of its luminance; 0: the texel is black.
    Rgb channel;                        ///< Of its channels; 0: that channel is black.
    std::array<float, 2> meanChroma{};  ///< Of R and G; all three sum to 3.
};

/// Texels as the numbers that a TexelModel makes ABRDFs of. A vector has `stride` numbers, those
/// past its texel's rank are 0; vectors of one kind stand one after the other.
struct TexelCodes {
    std::size_t stride = 0;
    std::vector<TexelScale> scales;
    std::vector<std::uint16_t> ranks;
    std::array<std::vector<float>, 4> logs;    ///< Of luminance, R, G and B.
    std::array<std::vector<float>, 2> chroma;  ///< Of R and G, about its mean.

    std::size_t count() const { return scales.size(); }
};

/// What the texels of a material have in common: with x = centre + basis . vector for the
/// logarithms of luminance and channels, and for chroma (texelColors() says how they become
/// colours).
struct TexelBasis {
    PackedMatrix luminance;  ///< Row, column.
    PackedMatrix chroma;
    std::array<std::vector<float>, 4> logCenters;  ///< A number a row.
    std::array<std::vector<float>, 2> chromaCenters;

    std::size_t rows() const { return luminance.rows(); }
};

/// How the parts of a colour come together.
struct TexelRule {
    float cap = 0;    ///< As TexelRows.
    float floor = 0;  ///< As TexelRows.
    float blend = 0;  ///< As TexelRows.

    std::size_t logVectors() const { return blend > 0 ? 4 : 1; }
    std::size_t chromaVectors() const { return blend < 1 ? 2 : 0; }
    std::size_t vectors() const { return logVectors() + chromaVectors(); }
};

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
