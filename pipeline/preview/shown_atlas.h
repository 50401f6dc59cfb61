// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas.h"
#include "color/color_config.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace abrdf {

/// The name of a space that a file states, as ColorConfig::transform() takes it: by its name, else
/// by its interop id, else over the config's aces_interchange. Throws std::runtime_error as
/// ColorConfig::spaceName(), naming the file, where the config reaches none of them.
std::string spaceOfFile(const ColorConfig& colors, const std::string& file,
                        const std::string& colorSpace, const std::string& interopId);

/// An atlas whose values are in `space`, which `colors` reaches; what was converted from
/// what to what is appended to `conversions`. Throws std::runtime_error for a file that is no
/// atlas and for an atlas of data.
Atlas atlasInSpace(const std::filesystem::path& path, const ColorConfig& colors,
                   const std::string& space, nlohmann::ordered_json& conversions);

/// {"what", "from", "to"}: an entry of such a list.
nlohmann::ordered_json conversion(const std::string& what, const std::string& from,
                                  const std::string& to);

}  // namespace abrdf
