// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace abrdf {

/// What the numbers of a UTIA BRDF file (.bin, EXR) mean: the readers in use disagree.
enum class UtiaEncoding {
    kLinear,   ///< Scene-linear as they are.
    kSrgb,     ///< Behind the sRGB curve.
    kSrgb140,  ///< Behind the sRGB curve, and 140 times as large.
};

/// "linear", "srgb" or "srgb140"; the inverse throws std::invalid_argument for other names.
std::string nameOf(UtiaEncoding encoding);
UtiaEncoding utiaEncodingFromName(const std::string& name);

/// Scene-linear value of a stored number, and the inverse. Exact for kLinear; the curve goes on
/// above 1 and mirrored below 0, as databases have such values.
double linearFromUtia(double stored, UtiaEncoding encoding);
double utiaFromLinear(double linear, UtiaEncoding encoding);

}  // namespace abrdf
