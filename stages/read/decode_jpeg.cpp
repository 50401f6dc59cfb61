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

using Decoder = std::unique_ptr<void, HandleCloser>;

/// The thread's own decoder.
Decoder& decoderOfThread() {
    thread_local Decoder decoder;
    if (!decoder) decoder.reset(tjInitDecompress());
    return decoder;
}

std::runtime_error faultOf(Decoder& decoder, const std::string& name) {
    const std::string why = tjGetErrorStr2(decoder.get());
    decoder.reset();  // After a fault it may take the next image's header for empty.
    return std::runtime_error(fmt::format("{}: is not a whole image: {}", name, why));
}

const unsigned char* dataOf(std::span<const char> bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

}  // namespace

std::optional<ImageSize> jpegSize(std::span<const char> bytes, const std::string& name,
                                  const ReadLimits& limits) {
    if (!beginsAsJpeg(bytes)) return {};
    Decoder& decoder = decoderOfThread();
    ImageSize size;
    int subsampling = 0;
    int colorSpace = 0;
    if (tjDecompressHeader3(decoder.get(), dataOf(bytes), bytes.size(), &size.width, &size.height,
                            &subsampling, &colorSpace) != 0) {
        throw faultOf(decoder, name);
    }
    if (colorSpace == TJCS_CMYK || colorSpace == TJCS_YCCK) return {};
    checkImageSize(size.width, size.height, bytes.size(), name, limits);
    return size;
}

std::optional<EncodedImage> decodeJpeg(std::span<const char> bytes, const std::string& name,
                                       const ReadLimits& limits) {
    const auto size = jpegSize(bytes, name, limits);
    if (!size) return {};
    Decoder& decoder = decoderOfThread();
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(size->width) *
                                  static_cast<std::size_t>(size->height));
    // At most 500 scans: a few kilobytes could else keep a core busy for hours.
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS;
    // A cut file is a warning there, with grey in place of what is missing.
    if (tjDecompress2(decoder.get(), dataOf(bytes), bytes.size(), rgb.data(), size->width, 0,
                      size->height, TJPF_RGB, kFlags) != 0) {
        throw faultOf(decoder, name);
    }
    return EncodedImage{size->width, size->height, std::move(rgb)};
}

}  // namespace abrdf
