// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/decode_jpeg.h"

#include "stages/read/decode_image.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <memory>
#include <stdexcept>

namespace abrdf {

namespace {

struct HandleCloser {
    void operator()(void* handle) const { tjDestroy(handle); }
};

bool beginsAsJpeg(std::span<const char> bytes) {
    return bytes.size() > 3 && bytes[0] == '\xff' && bytes[1] == '\xd8' && bytes[2] == '\xff';
}

}  // namespace

std::optional<EncodedImage> decodeJpeg(std::span<const char> bytes, const std::string& name) {
    if (!beginsAsJpeg(bytes)) return {};
    thread_local std::unique_ptr<void, HandleCloser> decoder;
    if (!decoder) decoder.reset(tjInitDecompress());
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    const auto fail = [&] {
        const std::string why = tjGetErrorStr2(decoder.get());
        decoder.reset();  // After a fault it may take the next image's header for empty.
        return std::runtime_error(fmt::format("{}: is not a whole image: {}", name, why));
    };
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colorSpace = 0;
    if (tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height, &subsampling,
                            &colorSpace) != 0) {
        throw fail();
    }
    if (colorSpace == TJCS_CMYK || colorSpace == TJCS_YCCK) return {};
    checkImageSize(width, height, name);
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width) *
                                  static_cast<std::size_t>(height));
    // A cut file is a warning there, with grey in place of what is missing.
    if (tjDecompress2(decoder.get(), data, bytes.size(), rgb.data(), width, 0, height, TJPF_RGB,
                      TJFLAG_ACCURATEDCT) != 0) {
        throw fail();
    }
    return EncodedImage{width, height, std::move(rgb)};
}

}  // namespace abrdf
