// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/known_display.h"

#include <string>

namespace abrdf {

/// The bytes of an ICC profile, version 4, of an RGB display: primaries and curve. Empty for PQ,
/// whose absolute light such a profile cannot state. The same bytes at any time.
std::string iccProfile(const DisplayEncoding& encoding);

}  // namespace abrdf
