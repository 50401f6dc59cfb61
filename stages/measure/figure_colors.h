// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace abrdf {

/// Okabe and Ito's colours, which most colour-blind people tell apart.
inline constexpr std::array kFigureColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};

}  // namespace abrdf
