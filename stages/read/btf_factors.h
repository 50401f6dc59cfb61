// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/btf_header.h"

#include <cstddef>
#include <span>
#include <vector>

namespace abrdf {

/// Sizes of a .btf: texels W*H, direction pairs light fastest (a = l + lights * v).
struct BtfExtent {
    std::size_t width = 0;
    std::size_t height = 0;
    std::size_t lights = 0;
    std::size_t views = 0;
    std::size_t channels = 0;

    std::size_t texels() const { return width * height; }
    std::size_t pairs() const { return lights * views; }
};

/// rows x columns numbers, row by row.
struct FactorMatrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<float> values;

    std::span<const float> row(std::size_t r) const {
        return std::span(values).subspan(r * columns, columns);
    }
};

/// out[stride * r] += rows [first, first + count) of `matrix` times `vector`.
void addProduct(const FactorMatrix& matrix, std::size_t first, std::size_t count,
                std::span<const float> vector, std::span<float> out, std::size_t stride);

/// One factorisation: value = sum over k of pairs[., k] * texels[., k].
struct BtfFactors {
    FactorMatrix pairs;   ///< A row a direction pair (times channels where imagesAsColumns is not).
    FactorMatrix texels;  ///< A row a texel (times channels where imagesAsColumns).
    bool imagesAsColumns = false;
};

/// Reads a factorisation block; `channels` values stand together in the rows of its U side.
/// Throws std::runtime_error where its sizes are not those of `extent` or of the file.
BtfFactors readBtfFactors(ByteCursor& file, const BtfExtent& extent, std::size_t channels);

/// Adds the image of pair `a`: out[stride * (c + channels * t)] for the block's channels c and all
/// texels t.
void addImage(const BtfFactors& factors, std::size_t a, std::size_t channels, std::span<float> out,
              std::size_t stride);

/// One view of a PVF: value = sum_k components[., k] * weights[., k] + mean[.].
struct BtfViewComponents {
    std::vector<float> mean;
    FactorMatrix components;
    FactorMatrix weights;
    bool imagesAsColumns = false;  ///< Components are images, weights lights; else the reverse.
};

BtfViewComponents readBtfViewComponents(ByteCursor& file, const BtfExtent& extent);

/// The image of light `l`: out[c + channels * t].
void decodeImage(const BtfViewComponents& view, const BtfExtent& extent, std::size_t light,
                 std::span<float> out);

}  // namespace abrdf
