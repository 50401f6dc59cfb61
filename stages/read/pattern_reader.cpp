// SPDX-License-Identifier: BSD-3-Clause
//
// --pattern: a folder or zip of images whose names tell their angles in a way of the user's own.
#include "stages/read/database_path.h"
#include "stages/read/decode_image.h"
#include "stages/read/name_pattern.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

namespace abrdf {

namespace {

/// True where fewer than nine tenths of the grid's pairs have an image: the views have different
/// sets of lights on purpose.
bool isListOfPairs(const std::vector<Photograph>& photographs) {
    std::set<std::pair<double, double>> lights;
    std::set<std::pair<double, double>> views;
    for (const Photograph& p : photographs) {
        lights.emplace(p.thetaLight, p.phiLight);
        views.emplace(p.thetaView, p.phiView);
    }
    return 10 * photographs.size() < 9 * lights.size() * views.size();
}

}  // namespace

bool recognizesPattern(const DatabasePath& path) {
    return !path.options.pattern.empty();
}

std::unique_ptr<BtfReader> makePatternReader(const DatabasePath& path) {
    const NamePattern pattern(path.options.pattern);
    if (!path.files) {
        throw std::runtime_error(
            fmt::format("{}: is neither a folder nor a .zip, which --pattern is meant for",
                        path.path.string()));
    }
    std::vector<Photograph> photographs;
    const std::vector<std::string>& names = path.files->names();
    for (std::size_t file = 0; file < names.size(); ++file) {
        if (!isImageName(names[file])) continue;
        if (const auto keys = pattern.match(names[file])) {
            photographs.push_back({file, keys->tl, keys->pl, keys->tv, keys->pv});
        }
    }
    if (photographs.empty()) {
        throw std::runtime_error(
            fmt::format("{}: none of its {} files is an image whose name fits the pattern '{}'",
                        path.path.string(), names.size(), path.options.pattern));
    }
    PhotographFormat format;
    format.name = "images by pattern";
    format.source = path.name();
    format.cosineFrom = "assumed: photographs of a flat sample";
    format.isList = isListOfPairs(photographs);
    return makePhotographReader(path.files, photographs, format);
}

}  // namespace abrdf
