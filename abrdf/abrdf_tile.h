// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/zeroed_vector.h"
#include "color/rgb.h"

#include <cstddef>
#include <span>

namespace abrdf {

/// Values of several texels, texel after texel, each with the same number of values: its samples
/// before reconstruction, all pairs of a grid after it (then one texel's span is its ABRDF).
class AbrdfTile {
  public:
    AbrdfTile() = default;
    AbrdfTile(std::size_t texelCount, std::size_t valuesPerTexel)
        : texelCount_(texelCount),
          valuesPerTexel_(valuesPerTexel),
          values_(texelCount * valuesPerTexel) {}

    std::size_t texelCount() const { return texelCount_; }
    std::size_t valuesPerTexel() const { return valuesPerTexel_; }

    std::span<Rgb> operator[](std::size_t texel) {
        return std::span(values_).subspan(texel * valuesPerTexel_, valuesPerTexel_);
    }
    std::span<const Rgb> operator[](std::size_t texel) const {
        return std::span(values_).subspan(texel * valuesPerTexel_, valuesPerTexel_);
    }

    std::span<Rgb> values() { return values_; }
    std::span<const Rgb> values() const { return values_; }

  private:
    std::size_t texelCount_ = 0;
    std::size_t valuesPerTexel_ = 0;
    ZeroedVector<Rgb> values_;
};

}  // namespace abrdf
