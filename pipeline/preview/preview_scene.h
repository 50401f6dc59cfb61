// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pipeline/preview/preview.h"
#include "stages/preview/render.h"

namespace abrdf {

/// A scene and what it points into.
struct PreparedScene {
    std::unique_ptr<Surface> surface;
    Scene scene;
    std::string environment;  ///< studio, sky, none or the file's name.
};

/// The lights of the options in the config's scene_linear: directional ones, and the environment
/// as options.samples lights. The brightest of the built-in ones shows a white Lambertian at 1.
PreparedScene prepareScene(const PreviewOptions& options, const ColorConfig& colors,
                           nlohmann::ordered_json& conversions);

}  // namespace abrdf
