// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/progress.h"
#include "color/color_config.h"
#include "stages/preview/camera.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace abrdf {

/// The shape that wears the material, or the figure that shows its table.
enum class PreviewKind { kSphere, kPlane, kDrape, kSheet, kPolar };

/// sphere | plane | drape | sheet | polar; throws std::invalid_argument for other names.
PreviewKind previewKindFromName(const std::string& name);
std::string nameOf(PreviewKind kind);

struct DirectionalLight {
    Radians azimuth = 0;
    Radians elevation = 0;
    double strength = 1;  ///< What a white Lambertian that faces it shows.
};

struct PreviewOptions {
    std::filesystem::path atlas;
    std::filesystem::path output;  ///< .exr, .png, .jpg or .jpeg.
    PreviewKind kind = PreviewKind::kSphere;
    std::optional<std::filesystem::path> colorConfig;
    int width = 512;
    int height = 512;
    std::optional<double> cameraAzimuth;    ///< Degrees; else the kind's own.
    std::optional<double> cameraElevation;  ///< Degrees; else the kind's own.
    double fieldOfView = 25;                ///< Degrees.
    std::vector<DirectionalLight> lights;
    std::string environment;       ///< studio, sky, a file, or none; empty: studio without lights.
    std::string environmentSpace;  ///< Of a file that does not say; empty: scene_linear.
    double turnEnvironment = 0;    ///< Degrees about the vertical axis.
    int samples = 2048;            ///< Lights that stand for an environment, 1 .. 1000000.
    double tiles = 0;              ///< Repeats of a map; 0: about two pixels a texel.
    double exposure = 1;           ///< Factor on the light, > 0.
    DisplayView display;           ///< PNG and JPEG alone.
    std::string outputSpace = "scene_linear";                  ///< EXR alone.
    std::optional<Rgb> background = Rgb{0.05F, 0.05F, 0.05F};  ///< Scene-linear; none: alpha.
    int bits = 0;                     ///< 8 or 16; 0: 16 for PQ displays, else 8.
    int quality = 95;                 ///< Of JPEG.
    bool draft = false;               ///< A quarter of the size comes first.
    std::filesystem::path reference;  ///< A measured atlas to compare with, for sheets.
    std::vector<std::string> pairs;   ///< "tl,pl,tv,pv" in degrees, for sheets; none: all.
};

/// Makes one picture. Returns the report: what was converted from what to what, times, sizes.
/// Throws std::runtime_error and std::invalid_argument with a sentence.
nlohmann::ordered_json preview(const PreviewOptions& options, const ProgressSink& progress);

}  // namespace abrdf
