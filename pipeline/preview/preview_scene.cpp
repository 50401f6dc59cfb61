// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/preview_scene.h"

#include "pipeline/preview/shown_atlas.h"
#include "stages/preview/built_in_light.h"
#include "stages/read/environment_reader.h"

#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

std::unique_ptr<Surface> surfaceOf(PreviewKind kind) {
    if (kind == PreviewKind::kPlane) return makePlane();
    if (kind == PreviewKind::kDrape) return makeDrape();
    return makeSphere();
}

CameraOptions cameraOf(const PreviewOptions& options) {
    const bool lies = options.kind != PreviewKind::kSphere;
    const bool drape = options.kind == PreviewKind::kDrape;
    CameraOptions camera;
    camera.azimuth = radiansFromDegrees(options.cameraAzimuth.value_or(drape ? 25 : 0));
    camera.elevation = radiansFromDegrees(options.cameraElevation.value_or(lies ? 38 : 0));
    camera.reach = lies ? 0.88 : 1;
    camera.fieldOfView = radiansFromDegrees(options.fieldOfView);
    return camera;
}

void convert(std::vector<Light>& lights, const ColorTransform& transform) {
    for (Light& light : lights) transform.apply({&light.strength, 1});
}

/// A file's light, in its own scene-linear units.
std::vector<Light> lightsOfFile(const PreviewOptions& options, const ColorConfig& colors,
                                ordered_json& conversions) {
    const EnvironmentFile file = readEnvironment(options.environment);
    const std::string name = std::filesystem::path(options.environment).filename().string();
    std::string space = options.environmentSpace;
    if (space.empty()) {
        space =
            file.interopId.empty() ? "scene_linear" : spaceOfFile(colors, name, "", file.interopId);
    }
    const std::string from = colors.spaceName(space);
    const std::string to = colors.spaceName("scene_linear");
    conversions.push_back(conversion(name, from, to));
    // The space is one of light: cells may be summed before they are converted.
    EnvironmentMap map = file.map;
    colors.transform(from, to).apply(map.radiance);
    return lightsOf(map, options.samples);
}

}  // namespace

PreparedScene prepareScene(const PreviewOptions& options, const ColorConfig& colors,
                           ordered_json& conversions) {
    PreparedScene prepared;
    prepared.surface = surfaceOf(options.kind);
    Scene& scene = prepared.scene;
    scene.surface = prepared.surface.get();
    scene.camera = cameraOf(options);
    prepared.environment = options.environment;
    if (prepared.environment.empty()) {
        prepared.environment = options.lights.empty() ? "studio" : "none";
    }
    if (prepared.environment == "studio") {
        scene.sky = lightsOf(studioEnvironment(), options.samples);
        normalize({&scene.sky});
    } else if (prepared.environment == "sky") {
        const EnvironmentMap sky = skyEnvironment(skySunDirection());
        scene.sky = lightsOf(sky, options.samples);
        scene.lights = {skySun(sky)};
        normalize({&scene.sky, &scene.lights});
        const std::string from = spaceOfFile(colors, "sky", "", "lin_rec709_scene");
        const std::string to = colors.spaceName("scene_linear");
        conversions.push_back(conversion("sky", from, to));
        const ColorTransform toLinear = colors.transform(from, to);
        convert(scene.sky, toLinear);
        convert(scene.lights, toLinear);
    } else if (prepared.environment != "none") {
        scene.sky = lightsOfFile(options, colors, conversions);
        prepared.environment = std::filesystem::path(options.environment).filename().string();
    }
    const Radians turn = radiansFromDegrees(options.turnEnvironment);
    scene.sky = turned(std::move(scene.sky), turn);
    scene.lights = turned(std::move(scene.lights), turn);
    for (const DirectionalLight& light : options.lights) {
        const auto strength = static_cast<float>(light.strength);
        scene.lights.push_back({vectorFromAzimuthElevation(light.azimuth, light.elevation),
                                {strength, strength, strength}});
    }
    return prepared;
}

}  // namespace abrdf
