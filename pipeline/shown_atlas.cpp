// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/shown_atlas.h"

#include "abrdf/for_each_texel.h"
#include "color/known_space.h"
#include "stages/read/atlas_reader.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

std::string spaceOfFile(const ColorConfig& colors, const std::string& file,
                        const std::string& colorSpace, const std::string& interopId) {
    std::string complaint;
    std::vector<std::string> names;
    if (!colorSpace.empty()) names.push_back(colorSpace);
    if (const auto known = knownSpaceFromInteropId(interopId)) {
        names.emplace_back(ocioName(*known));
        names.push_back(interopId);
    }
    for (const std::string& name : names) {
        try {
            return colors.spaceName(name);
        } catch (const std::runtime_error& error) {
            if (complaint.empty()) complaint = error.what();
        }
    }
    throw std::runtime_error(
        fmt::format("{}: {}", file,
                    complaint.empty() ? "does not say which colour space it is in" : complaint));
}

ordered_json conversion(const std::string& what, const std::string& from, const std::string& to) {
    return {{"what", what}, {"from", from}, {"to", to}};
}

Atlas atlasInSpace(const std::filesystem::path& path, const ColorConfig& colors,
                   const std::string& space, ordered_json& conversions) {
    Atlas atlas = readAtlas(path);
    AtlasHeader header = atlas.header();
    const std::string name = path.filename().string();
    const std::string from = spaceOfFile(colors, name, header.colorSpace, header.interopId);
    const std::string to = colors.spaceName(space);
    if (colors.isData(from)) {
        throw std::runtime_error(fmt::format(
            "{}: is in '{}', a space of data, so that its colours are unknown; convert it again "
            "with an --output-space",
            name, from));
    }
    conversions.push_back(conversion(name, from, to));
    const ColorTransform transform = colors.transform(from, to);
    if (transform.isIdentity()) return atlas;
    std::vector<Rgb> pixels = atlas.pixels();
    forEachTexelBlock(pixels.size(), 4096, [&](std::size_t begin, std::size_t end) {
        transform.apply(std::span(pixels).subspan(begin, end - begin));
    });
    header.colorSpace = to;
    const auto known = knownSpace(colors.aliases(to));
    header.interopId = known ? std::string(interopId(*known)) : "unknown";
    return {std::move(header), std::move(pixels)};
}

}  // namespace abrdf
