// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/model_atlas.h"

#include <filesystem>

namespace abrdf {

/// Reads what stages/write/model_writer.h writes. Throws std::runtime_error that names the file
/// where it is no whole model atlas.
ModelAtlas readModelAtlas(const std::filesystem::path& path);

}  // namespace abrdf
