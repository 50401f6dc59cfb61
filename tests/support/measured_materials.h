// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "color/rgb.h"

#include <vector>

namespace abrdf {

/// The ten measured materials and the rendered twill beside the checkout, each all pairs of
/// UBO2003's grid; none where they are absent.
std::vector<std::vector<Rgb>> measuredMaterials();

}  // namespace abrdf
