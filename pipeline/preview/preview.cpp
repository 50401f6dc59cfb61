// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/preview.h"

#include "abrdf/output_file.h"
#include "abrdf/stopwatch.h"
#include "pipeline/preview/picture_output.h"
#include "pipeline/preview/preview_figures.h"
#include "pipeline/preview/preview_scene.h"
#include "pipeline/preview/shown_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

constexpr std::array kKinds{
    std::pair{PreviewKind::kSphere, "sphere"}, std::pair{PreviewKind::kPlane, "plane"},
    std::pair{PreviewKind::kDrape, "drape"}, std::pair{PreviewKind::kSheet, "sheet"},
    std::pair{PreviewKind::kPolar, "polar"}};

/// What can be wrong with the options alone, asked before anything is read.
void check(const PreviewOptions& options) {
    checkOutputPath(options.output);
    const bool exr = pictureFormatOf(options.output) == PictureFormat::kExr;
    if (exr && options.display != DisplayView{}) {
        throw std::invalid_argument(
            "an EXR picture is scene-linear; --display, --view and --look are for .png and .jpg");
    }
    if (!exr && options.outputSpace != "scene_linear") {
        throw std::invalid_argument(
            "--output-space is for .exr; a .png or .jpg is made for a --display and --view");
    }
    if (options.samples < 1 || options.samples > 1'000'000) {
        throw std::invalid_argument("an environment is taken as 1 to 1000000 samples");
    }
    if (!(options.exposure > 0)) throw std::invalid_argument("the exposure must be above 0");
    if (options.bits != 0 && options.bits != 8 && options.bits != 16) {
        throw std::invalid_argument("a picture has 8 or 16 bits");
    }
    if (!(options.tiles >= 0)) throw std::invalid_argument("tiles must not be below 0");
}

/// Two pixels a texel in the middle of the picture.
double tilesOf(const PreviewOptions& options, const Atlas& atlas) {
    if (atlas.header().layout.texelCount() == 1) return 1;
    if (options.tiles > 0) return options.tiles;
    const double across = std::min(options.width, options.height) * 1.4;
    return std::max(1.0, std::round(across / (2 * atlas.header().layout.texelsHigh)));
}

/// Every pixel of a small picture as a square of the large one.
Picture enlarged(const Picture& small, int width, int height) {
    Picture large(width, height);
    for (std::size_t i = 0; i < large.count(); ++i) {
        const auto x = static_cast<int>(i % static_cast<std::size_t>(width));
        const auto y = static_cast<int>(i / static_cast<std::size_t>(width));
        const auto from = static_cast<std::size_t>(y * small.height / height) *
                              static_cast<std::size_t>(small.width) +
                          static_cast<std::size_t>(x * small.width / width);
        large.color[i] = small.color[from];
        large.alpha[i] = small.alpha[from];
        large.depth[i] = small.depth[from];
        large.normals[i] = small.normals[from];
    }
    return large;
}

void renderAndWrite(const PreviewOptions& options, const ColorConfig& colors, ordered_json& report,
                    const ProgressSink& progress) {
    const Stopwatch time;
    ordered_json& conversions = report["color"]["conversions"];
    const Atlas atlas = atlasInSpace(options.atlas, colors, "scene_linear", conversions);
    PreparedScene prepared = prepareScene(options, colors, conversions);
    prepared.scene.tiles = tilesOf(options, atlas);
    const Material material(atlas);
    report["environment"] = prepared.environment;
    report["lights"] = prepared.scene.lights.size();
    report["samples"] = prepared.scene.sky.size();
    report["tiles"] = prepared.scene.tiles;
    const double readSeconds = time.seconds();

    if (options.draft) {
        const Picture small = render(material, prepared.scene, std::max(1, options.width / 4),
                                     std::max(1, options.height / 4), {});
        ordered_json draft = report;
        writePicture(enlarged(small, options.width, options.height), options, colors, draft);
        report["time"]["draft"] = time.seconds();
    }
    const Stopwatch rendering;
    const Picture picture =
        render(material, prepared.scene, options.width, options.height, progress);
    const double renderSeconds = rendering.seconds();
    writePicture(picture, options, colors, report);
    report["time"]["read"] = readSeconds;
    report["time"]["render"] = renderSeconds;
    report["time"]["total"] = time.seconds();
}

}  // namespace

PreviewKind previewKindFromName(const std::string& name) {
    for (const auto& [kind, known] : kKinds) {
        if (name == known) return kind;
    }
    throw std::invalid_argument(
        fmt::format("there is no kind '{}': use sphere, plane, drape, sheet or polar", name));
}

std::string nameOf(PreviewKind kind) {
    return std::ranges::find(kKinds, kind, [](const auto& known) { return known.first; })->second;
}

ordered_json preview(const PreviewOptions& options, const ProgressSink& progress) {
    check(options);
    const ColorConfig colors = ColorConfig::load(options.colorConfig);
    if (pictureFormatOf(options.output) != PictureFormat::kExr) displayOutputOf(options, colors);
    ordered_json report;
    report["command"] = "preview";
    report["version"] = ABRDF_VERSION;
    report["atlas"] = options.atlas.filename().string();
    report["kind"] = nameOf(options.kind);
    report["size"] = {options.width, options.height};
    report["exposure"] = options.exposure;
    report["color"] = {{"config", colors.origin()},
                       {"working_space", colors.spaceName("scene_linear")},
                       {"conversions", ordered_json::array()}};
    if (options.kind == PreviewKind::kSheet || options.kind == PreviewKind::kPolar) {
        const Stopwatch time;
        drawFigure(options, colors, report);
        report["time"]["total"] = time.seconds();
    } else {
        renderAndWrite(options, colors, report, progress);
    }
    return report;
}

}  // namespace abrdf
