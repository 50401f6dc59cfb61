// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/btf_factors.h"

#include <cstdint>
#include <span>
#include <vector>

namespace abrdf {

/// The data of a BDI: every value as a half, texel after texel; looked up in the file itself.
class BtfTable {
  public:
    /// Reads the header behind the directions and finds the chunks. Throws std::runtime_error.
    BtfTable(ByteCursor& file, BtfExtent& extent);

    /// The image of pair `a`: out[c + channels * t]; NaN at texels that the mask leaves out.
    void decode(std::size_t a, std::span<float> out) const;

  private:
    BtfExtent extent_;
    std::vector<std::span<const char>> texels_;  ///< The bytes of each texel; empty: masked.
};

}  // namespace abrdf
