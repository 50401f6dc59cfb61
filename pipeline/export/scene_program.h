// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/export/export.h"

#include <string>
#include <vector>

namespace abrdf {

/// A folder that a renderer takes as it stands: the material in its format, and a scene around it.
struct SceneJob {
    ExportJob material;   ///< `format` is the scene's; `output` the folder, made where absent.
    std::string program;  ///< One of scenePrograms().
    double lightAzimuth = -35;   ///< Degrees, of a distant light, as previews count them.
    double lightElevation = 45;  ///< Degrees. Blender's is the nearest light of the atlas.
};

/// blender, mitsuba, pbrt, radiance.
std::vector<std::string> scenePrograms();

/// Writes the folder. The report's "run" is the command that renders it, in that folder, and for
/// Blender "preview" the one that must look the same. Throws std::invalid_argument for an unknown
/// program, else as exportBrdf().
nlohmann::ordered_json exportScene(const SceneJob& job, const ProgressSink& progress);

/// Blender's part: the atlas as a spatial one of a single light, and which of its views a viewer
/// lies between. Throws std::runtime_error where the input is no atlas.
nlohmann::ordered_json writeBlenderScene(const SceneJob& job);

}  // namespace abrdf
