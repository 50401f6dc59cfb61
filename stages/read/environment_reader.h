// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/environment_map.h"

#include <filesystem>
#include <string>

namespace abrdf {

struct EnvironmentFile {
    EnvironmentMap map;
    std::string interopId;  ///< The file's colorInteropID; empty where it has none.
};

/// Reads an environment of longitude and latitude (.exr, .hdr, anything OpenImageIO reads).
/// Throws std::runtime_error that names the file where it is none or has fewer than 3 channels.
EnvironmentFile readEnvironment(const std::filesystem::path& path);

}  // namespace abrdf
