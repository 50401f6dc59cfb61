// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"

#include <filesystem>
#include <vector>

namespace abrdf {

/// True for an OpenEXR file whose header is an atlas's.
bool isAtlas(const std::filesystem::path& path);

/// What the file says of itself. Throws std::runtime_error that names it and what is wrong.
AtlasHeader readAtlasHeader(const std::filesystem::path& path);

/// The whole atlas. Throws as readAtlasHeader().
Atlas readAtlas(const std::filesystem::path& path);

/// The Delta E that the method expected of each texel, row by row from the top; NaN where it knew
/// none. Empty where the file has no part `estimate`. Throws as readAtlasHeader().
std::vector<float> readEstimates(const std::filesystem::path& path);

}  // namespace abrdf
