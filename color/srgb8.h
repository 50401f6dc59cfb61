// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace abrdf {

/// 8-bit sRGB code values.
using Srgb8 = std::array<std::uint8_t, 3>;

}  // namespace abrdf
