// SPDX-License-Identifier: BSD-3-Clause
#include "color/known_space.h"

#include <algorithm>

namespace abrdf {

namespace {

constexpr std::array<float, 2> kD65 = {0.3127F, 0.3290F};
constexpr std::array<float, 2> kAcesWhite = {0.32168F, 0.33767F};  // SMPTE ST 2065-1

// ITU-R BT.709, SMPTE EG 432-1, ITU-R BT.2020, Academy S-2014-004, SMPTE ST 2065-1.
constexpr Primaries kRec709 = {{0.64F, 0.33F}, {0.30F, 0.60F}, {0.15F, 0.06F}, kD65};
constexpr Primaries kP3D65 = {{0.680F, 0.320F}, {0.265F, 0.690F}, {0.150F, 0.060F}, kD65};
constexpr Primaries kRec2020 = {{0.708F, 0.292F}, {0.170F, 0.797F}, {0.131F, 0.046F}, kD65};
constexpr Primaries kAp1 = {{0.713F, 0.293F}, {0.165F, 0.830F}, {0.128F, 0.044F}, kAcesWhite};
constexpr Primaries kAp0 = {{0.7347F, 0.2653F}, {0.0F, 1.0F}, {0.0001F, -0.0770F}, kAcesWhite};
// OpenEXR's white is the xy of (1, 1, 1), whatever white the values were adapted to.
constexpr std::array<float, 2> kEqualEnergy = {1.0F / 3, 1.0F / 3};
constexpr Primaries kXyz = {{1.0F, 0.0F}, {0.0F, 1.0F}, {0.0F, 0.0F}, kEqualEnergy};

struct Row {
    KnownSpace space;
    std::string_view ocioName;
    std::string_view interopId;
    Primaries primaries;
    // Further names in the ASWF and Blender configs; never one with a second meaning ("linear").
    std::array<std::string_view, 5> otherNames;
};

constexpr std::array kRows{
    Row{KnownSpace::kLinearRec709,
        "Linear Rec.709 (sRGB)",
        "lin_rec709_scene",
        kRec709,
        {"lin_rec709_srgb", "lin_rec709", "lin_srgb", "Utility - Linear - Rec.709",
         "Utility - Linear - sRGB"}},
    Row{KnownSpace::kLinearP3D65,
        "Linear P3-D65",
        "lin_p3d65_scene",
        kP3D65,
        {"lin_p3d65", "lin_displayp3", "Utility - Linear - P3-D65", "Linear DCI-P3 D65"}},
    Row{KnownSpace::kLinearRec2020,
        "Linear Rec.2020",
        "lin_rec2020_scene",
        kRec2020,
        {"lin_rec2020", "Utility - Linear - Rec.2020"}},
    Row{KnownSpace::kAcesCg, "ACEScg", "lin_ap1_scene", kAp1, {"lin_ap1", "ACES - ACEScg"}},
    Row{KnownSpace::kAces2065,
        "ACES2065-1",
        "lin_ap0_scene",
        kAp0,
        {"lin_ap0", "aces2065_1", "ACES - ACES2065-1"}},
    Row{KnownSpace::kCieXyzD65,
        "CIE XYZ-D65 - Scene-referred",
        "lin_ciexyzd65_scene",
        kXyz,
        {"lin_ciexyzd65", "cie_xyz_d65_scene", "Linear CIE-XYZ D65"}},
    Row{KnownSpace::kSrgbTexture,
        "sRGB - Texture",
        "srgb_rec709_scene",
        kRec709,
        {"srgb_tx", "srgb_texture", "sRGB Encoded Rec.709 (sRGB)", "srgb_encoded_rec709",
         "Utility - sRGB - Texture"}},
};

constexpr bool rowsFollowTheEnumeration() {
    for (std::size_t i = 0; i < kRows.size(); ++i) {
        if (kRows[i].space != static_cast<KnownSpace>(i)) return false;
    }
    return true;
}
static_assert(rowsFollowTheEnumeration());

const Row& row(KnownSpace space) {
    return kRows.at(static_cast<std::size_t>(space));
}

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// OCIO takes no heed of case either.
bool sameName(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return lower(x) == lower(y); });
}

bool answersTo(const Row& candidate, std::string_view name) {
    if (name.empty()) return false;  // Unused places among otherNames are empty.
    const auto& others = candidate.otherNames;
    return sameName(name, candidate.ocioName) || sameName(name, candidate.interopId) ||
           std::any_of(others.begin(), others.end(),
                       [&](std::string_view other) { return sameName(name, other); });
}

}  // namespace

std::string_view ocioName(KnownSpace space) {
    return row(space).ocioName;
}

std::string_view interopId(KnownSpace space) {
    return row(space).interopId;
}

Primaries primaries(KnownSpace space) {
    return row(space).primaries;
}

std::optional<KnownSpace> knownSpace(const std::vector<std::string>& namesAndAliases) {
    for (const std::string& name : namesAndAliases) {
        for (const Row& candidate : kRows) {
            if (answersTo(candidate, name)) return candidate.space;
        }
    }
    return std::nullopt;
}

std::optional<KnownSpace> knownSpaceFromInteropId(std::string_view id) {
    for (const Row& candidate : kRows) {
        if (candidate.interopId == id) return candidate.space;
    }
    return std::nullopt;
}

}  // namespace abrdf
