// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"

#include <filesystem>

namespace abrdf {

/// True for an OpenEXR file whose header is an atlas's.
bool isAtlas(const std::filesystem::path& path);

/// What the file says of itself. Throws std::runtime_error that names it and what is wrong.
AtlasHeader readAtlasHeader(const std::filesystem::path& path);

/// The whole atlas. Throws as readAtlasHeader().
Atlas readAtlas(const std::filesystem::path& path);

}  // namespace abrdf
