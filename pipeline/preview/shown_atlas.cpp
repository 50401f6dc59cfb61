// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/shown_atlas.h"

#include "abrdf/for_each_texel.h"
#include "color/known_space.h"
#include "stages/read/atlas_reader.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

using nlohmann::ordered_json;

std::string spaceOfFile(const ColorConfig& colors, const std::string& file,
                        const std::string& colorSpace, const std::string& interopId) {
    std::vector<std::string> names;
    if (!colorSpace.empty()) names.push_back(colorSpace);
    if (const auto known = knownSpaceFromInteropId(interopId)) {
        names.push_back(interopId);
        names.emplace_back(ocioName(*known));
    }
    if (names.empty()) {
        throw std::runtime_error(file + ": does not say which colour space it is in");
    }
    for (const std::string& name : names) {
        if (colors.has(name)) return colors.spaceName(name);
    }
    if (colors.reaches(names.back())) return names.back();
    try {
        return colors.spaceName(names.front());
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", file, error.what()));
    }
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
    const std::string to = colors.has(space) ? colors.spaceName(space) : space;
    if (colors.has(from) && colors.isData(from)) {
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
    header.conversion = from + " -> " + to;
    const auto known =
        knownSpace(colors.has(to) ? colors.aliases(to) : std::vector<std::string>{to});
    header.interopId = known ? std::string(interopId(*known)) : "unknown";
    return {std::move(header), std::move(pixels)};
}

}  // namespace abrdf
