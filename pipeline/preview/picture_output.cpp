// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/picture_output.h"

#include "abrdf/for_each_texel.h"
#include "abrdf/output_file.h"
#include "color/known_space.h"
#include "pipeline/preview/shown_atlas.h"
#include "stages/preview/encode_picture.h"
#include "stages/write/coded_file.h"
#include "stages/write/picture_exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

namespace {

constexpr const char* kSceneLinear = "scene_linear";

/// "cloth.exr: Linear Rec.709 (sRGB) -> ACEScg; ...": what a file's header says of its colours.
std::string textOfConversions(const ordered_json& conversions) {
    std::string text;
    for (const ordered_json& step : conversions) {
        text +=
            fmt::format("{}{}: {} -> {}", text.empty() ? "" : "; ", step["what"].get<std::string>(),
                        step["from"].get<std::string>(), step["to"].get<std::string>());
    }
    return text;
}

void writeExr(Picture picture, const PreviewOptions& options, const ColorConfig& colors,
              ordered_json& report) {
    const std::string from = colors.spaceName(kSceneLinear);
    const std::string to = colors.spaceName(options.outputSpace);
    if (colors.isData(to)) {
        throw std::invalid_argument(
            fmt::format("'{}' is a space of data; a picture's colours need one of light", to));
    }
    const ColorTransform transform = colors.transform(from, to);
    const auto exposure = static_cast<float>(options.exposure);
    forEachTexelBlock(picture.count(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) picture.color[i] *= exposure;
        transform.apply(std::span(picture.color).subspan(begin, end - begin));
    });
    ordered_json& color = report["color"];
    color["conversions"].push_back(conversion("picture", from, to));
    const auto known = knownSpace(colors.aliases(to));
    auto parts = partsOf(picture, to, known ? std::string(interopId(*known)) : "unknown");
    parts[0].notes = {{"abrdf:conversions", textOfConversions(color["conversions"])}};
    const std::uint64_t bytes = writeExrParts(options.output, parts);
    report["output"] = {{"path", options.output.string()},
                        {"bytes", bytes},
                        {"color_space", to},
                        {"parts", {"rgba", "depth", "normals"}}};
}

}  // namespace

PictureFormat pictureFormatOf(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    if (ending == ".exr") return PictureFormat::kExr;
    if (ending == ".png") return PictureFormat::kPng;
    if (ending == ".jpg" || ending == ".jpeg") return PictureFormat::kJpeg;
    throw std::invalid_argument(
        fmt::format("{}: its ending says no format; use .exr, .png or .jpg", path.string()));
}

DisplayOutput displayOutputOf(const PreviewOptions& options, const ColorConfig& colors) {
    DisplayOutput output;
    output.shown = colors.resolved(options.display, kSceneLinear);
    output.transform = colors.displayTransform(kSceneLinear, output.shown);
    const std::vector<std::string> names = colors.encodedSpace(output.shown, kSceneLinear);
    output.space = names.front();
    if (!colors.isData(names.front())) output.encoding = knownDisplay(names);
    const bool pq = output.encoding && output.encoding->curve == DisplayCurve::kPq;
    output.bits = options.bits != 0 ? options.bits : pq ? 16 : 8;
    if (pq && output.bits == 8) {
        throw std::invalid_argument("8 bits are too coarse for a PQ display; use --bits 16");
    }
    return output;
}

void writeCoded(CodedPicture picture, const PreviewOptions& options, const DisplayOutput& display,
                ordered_json& report) {
    picture.encoding = display.encoding;
    ordered_json& color = report["color"];
    color["display"] = display.shown.display;
    color["view"] = display.shown.view;
    if (!display.shown.look.empty()) color["look"] = display.shown.look;
    color["encoding"] = display.encoding ? display.encoding->name : "unknown";
    picture.notes = {
        {"Software", "abrdf"},
        {"Comment", fmt::format("{}; display {}, view {}, exposure {:g}",
                                textOfConversions(color["conversions"]), display.shown.display,
                                display.shown.view, options.exposure)}};
    const std::string bytes = pictureFormatOf(options.output) == PictureFormat::kPng
                                  ? pngBytes(picture)
                                  : jpegBytes(picture, options.quality);
    writeWholeFile(options.output, bytes);
    report["output"] = {{"path", options.output.string()},
                        {"bytes", bytes.size()},
                        {"bits", picture.bits},
                        {"channels", picture.channels}};
}

void writePicture(const Picture& picture, const PreviewOptions& options, const ColorConfig& colors,
                  ordered_json& report) {
    if (pictureFormatOf(options.output) == PictureFormat::kExr) {
        writeExr(picture, options, colors, report);
        return;
    }
    const DisplayOutput display = displayOutputOf(options, colors);
    const bool dither = pictureFormatOf(options.output) == PictureFormat::kPng;
    const EncodeOptions encode{options.exposure, options.background, display.bits, dither};
    report["color"]["conversions"].push_back(
        conversion("picture", colors.spaceName(kSceneLinear), display.space));
    writeCoded(encodePicture(picture, display.transform, encode), options, display, report);
}

}  // namespace abrdf
