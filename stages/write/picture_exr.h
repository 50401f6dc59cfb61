// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "abrdf/atlas_header.h"
#include "abrdf/picture.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace abrdf {

/// One part of a multi-part EXR picture: channels of one size, in float or half.
struct ExrPart {
    struct Channel {
        std::string name;           ///< "R", "Z", "N.X" ...
        std::vector<float> values;  ///< Row by row from the top.
        bool asHalf = false;        ///< Values above 65504 are cut to it.
    };
    std::string name;
    int width = 0;
    int height = 0;
    std::vector<Channel> channels;
    std::string colorSpace;  ///< OpenColorIO name; empty for data, which has no colour space.
    std::string interopId;   ///< As an atlas's; chromaticities follow from it. Data: "data".
    std::vector<std::pair<std::string, std::string>> notes = {};  ///< Further attributes of text.
    std::vector<std::pair<std::string, float>> numbers = {};      ///< The same of numbers.
    const AtlasHeader* atlas = nullptr;  ///< Stored in the part's header, with its colour space.
};

/// The parts of a rendered picture: "rgba" with R, G, B, A, then "depth" and "normals" as data.
std::vector<ExrPart> partsOf(const Picture& picture, const std::string& colorSpace,
                             const std::string& interopId);

/// Writes the parts in their order, ZIP-compressed; the same values give the same bytes. Returns
/// the file's size. Throws std::runtime_error that names the file.
std::uint64_t writeExrParts(const std::filesystem::path& path, const std::vector<ExrPart>& parts);

}  // namespace abrdf
