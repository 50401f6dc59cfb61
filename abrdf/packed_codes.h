// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/texel_model.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace abrdf {

/// Codes of many texels, each with as many numbers as its rank asks for.
class PackedCodes {
  public:
    PackedCodes() = default;
    PackedCodes(TexelRule rule, std::size_t texels);

    std::size_t count() const { return texels_.size(); }

    /// Texels [first, first + codes.count()); of different texels from any thread.
    void store(std::size_t first, const TexelCodes& codes);

    /// Some texels, as TexelModel takes them.
    TexelCodes unpacked(std::span<const std::size_t> texels) const;

    std::uint16_t rank(std::size_t texel) const { return texels_[texel].rank; }
    const TexelScale& scale(std::size_t texel) const { return texels_[texel].scale; }
    std::size_t largestRank() const;

    /// Number `k` of vector `which`: luminance, then R, G and B where channels have a share, then
    /// chroma of R and G where it has one; 0 past the rank.
    float number(std::size_t texel, std::size_t which, std::size_t k) const {
        const Texel& t = texels_[texel];
        return k < t.rank ? t.numbers[which * t.rank + k] : 0;
    }
    std::size_t vectors() const { return rule_.vectors(); }

    /// A texel as read from a file: numbers, vector after vector.
    void store(std::size_t texel, const TexelScale& scale, std::uint16_t rank,
               std::vector<float> numbers) {
        texels_[texel] = {scale, rank, std::move(numbers)};
    }

  private:
    struct Texel {
        TexelScale scale;
        std::uint16_t rank = 0;
        std::vector<float> numbers;
    };

    TexelRule rule_;
    std::vector<Texel> texels_;
};

}  // namespace abrdf
