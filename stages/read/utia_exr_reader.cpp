// SPDX-License-Identifier: BSD-3-Clause
//
// UTIA BRDF EXR: a 288 x 288 RGB image, rows light, columns view.
#include "stages/read/atlas_reader.h"
#include "stages/read/decode_image.h"
#include "stages/read/mapped_file.h"
#include "stages/read/utia_brdf.h"

#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

namespace {

constexpr int kSide = 288;

constexpr std::string_view kExrMagic = "\x76\x2f\x31\x01";

/// Decoding goes by the extension, which the file may lack.
std::string exrName(const DatabasePath& path) {
    const std::string name = path.path.string();
    return name.ends_with(".exr") ? name : name + ".exr";
}

}  // namespace

bool recognizesUtiaExr(const DatabasePath& path) {
    if (path.files || !path.head.starts_with(kExrMagic) || isAtlas(path.path)) return false;
    try {
        const MappedFile map(path.path);
        const ImageSize size = imageSize(map.bytes(), exrName(path), path.options.limits);
        return size.width == kSide && size.height == kSide;
    } catch (const std::runtime_error&) {
        return false;
    }
}

std::unique_ptr<BtfReader> makeUtiaExrReader(const DatabasePath& path) {
    const MappedFile map(path.path);
    const EncodedImage image = decodeImage(map.bytes(), exrName(path), path.options.limits);
    map.checkWhole();
    const auto* floats = std::get_if<std::vector<float>>(&image.rgb);
    if (floats == nullptr) {
        throw std::runtime_error(
            fmt::format("{}: holds no floating-point values", path.path.string()));
    }
    std::vector<std::array<double, 3>> stored(floats->size() / 3);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            stored[i][c] = static_cast<double>((*floats)[3 * i + c]);
        }
    }
    return makeUtiaBrdfReader(path, "UTIA BRDF EXR", stored);
}

}  // namespace abrdf
