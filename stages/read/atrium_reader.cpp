// SPDX-License-Identifier: BSD-3-Clause
//
// ATRIUM (University of Bonn): UBO2003's names, 81 lights x 81 views, either 800 x 800 JPEG in sRGB
// or Radiance HDR, whose values are linear.
#include "stages/read/angle_keys.h"
#include "stages/read/database_path.h"
#include "stages/read/decode_image.h"

#include <stdexcept>
#include <string_view>

namespace abrdf {

namespace {

constexpr int kAtriumSide = 800;

bool beginsAsRadiance(const std::vector<char>& bytes) {
    const std::string_view text(bytes.data(), bytes.size());
    return text.starts_with("#?RADIANCE") || text.starts_with("#?RGBE");
}

}  // namespace

bool recognizesAtrium(const DatabasePath& path) {
    if (!path.files) return false;
    const auto first = firstNamedByAngles(*path.files);
    if (!first) return false;
    try {
        const std::vector<char> bytes = path.files->read(*first);
        if (beginsAsRadiance(bytes)) return true;
        const ImageSize size = imageSize(bytes, path.files->fullName(*first), path.options.limits);
        return size.width == kAtriumSide && size.height == kAtriumSide;
    } catch (const std::runtime_error&) {
        return false;  // The reader that does take it will name the file.
    }
}

std::unique_ptr<BtfReader> makeAtriumReader(const DatabasePath& path) {
    PhotographFormat format;
    format.name = "ATRIUM";
    format.source = path.name();
    return makePhotographReader(path.files, photographsNamedByAngles(*path.files), format);
}

}  // namespace abrdf
