// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/angular_grid.h"
#include "color/rgb.h"

#include <filesystem>
#include <functional>
#include <string>

namespace abrdf {

/// A small stack of images in UBO2003's names.
struct SyntheticBtf {
    AngularGrid grid = AngularGrid(ubo81Directions());
    int width = 1;
    int height = 1;
    std::string extension =
        "exr";  ///< exr: float, values as they are; png, jpg: values as code / 255.
    std::function<Rgb(const LightAndView& pair, int x, int y)> value;
};

/// The file of a pair below the folder.
std::filesystem::path syntheticFile(const SyntheticBtf& btf, std::size_t pair);

/// Writes all images below `folder`.
void writeSyntheticBtf(const std::filesystem::path& folder, const SyntheticBtf& btf);

/// A table of float32 [light 81][view 81][RGB] of ../shared/data; empty where that is absent.
std::vector<Rgb> sharedTable(const std::string& name);

/// All bytes of a file.
std::string bytesOf(const std::filesystem::path& file);

}  // namespace abrdf
