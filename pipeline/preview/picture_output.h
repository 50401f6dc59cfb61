// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/coded_picture.h"
#include "abrdf/picture.h"
#include "pipeline/preview/preview.h"

namespace abrdf {

/// What a file's ending says of it.
enum class PictureFormat { kExr, kPng, kJpeg };

/// Throws std::invalid_argument for an ending that is none of .exr, .png, .jpg, .jpeg.
PictureFormat pictureFormatOf(const std::filesystem::path& path);

/// How codes of a display are made of scene_linear, decided before anything is rendered.
struct DisplayOutput {
    DisplayView shown;
    ColorTransform transform;
    std::optional<DisplayEncoding> encoding;  ///< Nothing: none that files can state.
    std::string space;                        ///< The config's name of the codes' space.
    int bits = 8;
};
DisplayOutput displayOutputOf(const PreviewOptions& options, const ColorConfig& colors);

/// Writes a rendered picture in scene_linear, in its format. Adds what was done to `report`:
/// conversions, display, encoding, bytes.
void writePicture(const Picture& picture, const PreviewOptions& options, const ColorConfig& colors,
                  nlohmann::ordered_json& report);

/// Writes finished codes as PNG or JPEG. Adds encoding and bytes to `report`.
void writeCoded(CodedPicture picture, const PreviewOptions& options, const DisplayOutput& display,
                nlohmann::ordered_json& report);

}  // namespace abrdf
