// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/known_space.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// How a display's codes become light.
enum class DisplayCurve {
    kSrgb,   ///< IEC 61966-2-1.
    kPower,  ///< light = code^gamma.
    kPq,     ///< SMPTE ST 2084.
};

/// An encoding that image files can state; what pictures for displays are tagged by.
struct DisplayEncoding {
    std::string name;  ///< "sRGB", "Display P3" ...
    Primaries primaries{};
    DisplayCurve curve = DisplayCurve::kSrgb;
    double gamma = 0;  ///< Of kPower.
    /// Colour primaries, transfer function, matrix and range of ITU-T H.273; none where the
    /// tables there have no such curve.
    std::optional<std::array<std::uint8_t, 4>> cicp;
};

/// The encoding of a display's space, found by its names; nothing where it is none of ours, so
/// that a file never claims what it does not hold.
std::optional<DisplayEncoding> knownDisplay(const std::vector<std::string>& namesAndAliases);

}  // namespace abrdf
