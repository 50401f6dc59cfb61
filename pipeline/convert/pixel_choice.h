// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/pixel_type.h"

namespace abrdf {

/// The pixels that a user asks of an atlas.
enum class PixelChoice {
    kAuto,  ///< Half where every value fits, else float.
    kHalf,
    kFloat,
};

/// The type that an atlas begins with; kAuto begins anew as float at a value that no half holds.
constexpr PixelType firstType(PixelChoice choice) {
    return choice == PixelChoice::kFloat ? PixelType::kFloat : PixelType::kHalf;
}

}  // namespace abrdf
