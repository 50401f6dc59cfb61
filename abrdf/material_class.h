// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace abrdf {

/// The kinds of random materials that the prior learns from, a covariance each.
enum class MaterialClass {
    kIso,    ///< One facet without a direction of its own.
    kAniso,  ///< One facet: brushed lobes, fibres.
    kTilt,   ///< Two to six facets tilted anyhow.
    kWoven,  ///< Warp and weft, tilted to and fro along their threads.
    kRibs,   ///< Facets tilted about one axis, as corduroy's.
};

inline constexpr std::array kMaterialClasses = {MaterialClass::kIso, MaterialClass::kAniso,
                                                MaterialClass::kTilt, MaterialClass::kWoven,
                                                MaterialClass::kRibs};

/// "iso", "aniso", "tilt", "woven" or "ribs".
constexpr const char* nameOf(MaterialClass materialClass) {
    constexpr std::array kNames = {"iso", "aniso", "tilt", "woven", "ribs"};
    return kNames[static_cast<std::size_t>(materialClass)];
}

}  // namespace abrdf
