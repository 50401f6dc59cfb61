// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/read/byte_cursor.h"

#include <array>
#include <cstdint>
#include <span>

namespace abrdf {

/// The small number that the logarithmic forms of .btf files add before the logarithm.
constexpr float kBtfEpsilon = 1e-5F;

/// How the decoded channels of a DFMF become colours.
struct BtfColorModel {
    std::int32_t number = 0;  ///< 0 as they are; 1 YUV; 3 PCA; 4 YCoCg; 9, 10, 11 log YUV; 12 log.
    std::array<float, 3> mean{};    ///< Of model 3.
    std::array<float, 9> matrix{};  ///< Of model 3, row by row.
};

/// Throws std::runtime_error, naming the file, for models that are not decoded: those for spectra
/// and the one that needs a profile, and for other than three channels where the model mixes them.
BtfColorModel readBtfColorModel(ByteCursor& file, std::size_t channels);

/// Converts packed values in place; channels: 1 .. ; three where the model mixes them.
void applyColorModel(const BtfColorModel& model, std::size_t channels, std::span<float> values);

}  // namespace abrdf
