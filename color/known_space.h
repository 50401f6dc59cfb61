// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace abrdf {

/// The colour spaces whose primaries files can state: the one source of both EXR attributes,
/// `chromaticities` and `colorInteropID` (ASWF Color Interop Forum).
enum class KnownSpace {
    kLinearRec709,
    kLinearP3D65,
    kLinearRec2020,
    kAcesCg,
    kAces2065,
    kCieXyzD65,
    kSrgbTexture,
};

/// CIE 1931 xy of red, green, blue and white.
struct Primaries {
    std::array<float, 2> red, green, blue, white;
};

/// OCIO name in the ASWF ACES configs: "ACEScg", "Linear Rec.709 (sRGB)" ...
std::string_view ocioName(KnownSpace space);

/// "lin_ap1_scene", "lin_rec709_scene" ...
std::string_view interopId(KnownSpace space);

Primaries primaries(KnownSpace space);

/// Finds the space among the names and aliases under which a config knows it; nothing where the
/// space is none of ours, so that a file never claims primaries it does not have.
std::optional<KnownSpace> knownSpace(const std::vector<std::string>& namesAndAliases);

/// The space of a stored interop id.
std::optional<KnownSpace> knownSpaceFromInteropId(std::string_view id);

}  // namespace abrdf
