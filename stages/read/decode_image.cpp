// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/decode_image.h"

#include "stages/read/decode_jpeg.h"
#include "stages/read/exr_header_check.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace abrdf {

namespace {

// A photograph of a material sample; a header that declares more is a lie.
constexpr int kMaxImageSide = 1 << 15;

// Deflate makes at most 1032 bytes of one, a JPEG's empty blocks 1024.
constexpr std::size_t kMaxExpansion = 4096;

std::string lowerExtension(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos || name.find('/', dot) != std::string::npos) return {};
    std::string extension = name.substr(dot + 1);
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::set<std::string> imageExtensions() {
    // "jpeg:jpg,jpe,jpeg;png:png;..."
    std::string list;
    OIIO::getattribute("extension_list", list);
    std::set<std::string> extensions;
    std::string word;
    for (const char c : list + ";") {
        if (c == ',' || c == ';') {
            extensions.insert(word);
            word.clear();
        } else if (c == ':') {
            word.clear();
        } else {
            word += c;
        }
    }
    extensions.erase("");
    extensions.erase("null");
    return extensions;
}

std::runtime_error badImage(const std::string& name, std::string why) {
    for (std::size_t at = why.find('\n'); at != std::string::npos; at = why.find('\n', at)) {
        why.replace(at, 1, "; ");
    }
    return std::runtime_error(fmt::format("{}: is not a whole image: {}", name, why));
}

/// The first three channels, or the first one three times; no others take memory.
template <typename T>
std::vector<T> readPixels(OIIO::ImageInput& input, OIIO::TypeDesc type, const std::string& name) {
    const OIIO::ImageSpec& spec = input.spec();
    const bool isGrey = spec.nchannels < 3;
    std::vector<T> values(static_cast<std::size_t>(spec.width) *
                          static_cast<std::size_t>(spec.height) * (isGrey ? 1 : 3));
    const bool read = input.read_image(0, 0, 0, isGrey ? 1 : 3, type, values.data());
    // The JPEG reader fills a truncated image with grey, calls it read, and leaves a message.
    const std::string message = input.geterror();
    if (!read || !message.empty()) throw badImage(name, message);
    if (!isGrey) return values;
    std::vector<T> rgb;
    rgb.reserve(3 * values.size());
    for (const T value : values) rgb.insert(rgb.end(), 3, value);
    return rgb;
}

/// OpenEXR's channels have names in any number: R, G and B, or a grey one, else there is no telling
/// which are meant. OpenImageIO puts R, G and B first.
void checkChannels(const OIIO::ImageSpec& spec, const std::string& name) {
    const std::vector<std::string>& names = spec.channelnames;
    // "R" of "R", "Red" and "beauty.R".
    const auto initialOf = [](const std::string& channel) {
        const std::size_t begin = channel.rfind('.') + 1;
        return begin < channel.size() ? std::toupper(static_cast<unsigned char>(channel[begin]))
                                      : 0;
    };
    const bool isColor = names.size() >= 3 && initialOf(names[0]) == 'R' &&
                         initialOf(names[1]) == 'G' && initialOf(names[2]) == 'B';
    const bool isGrey = names.size() == 1 || (names.size() == 2 && names[0] == "Y");
    if (isColor || isGrey) return;
    throw badImage(name,
                   fmt::format("its channels are {}, and R, G and B, or a grey one, are needed",
                               fmt::join(names, ", ")));
}

/// An image that OpenImageIO has opened from memory, and whose header is possible.
struct OpenImage {
    OpenImage(std::span<const char> bytes, const std::string& name, const ReadLimits& limits)
        : memory(const_cast<char*>(bytes.data()), bytes.size()) {
        if (beginsAsExr(bytes)) checkExrHeader(bytes, name);
        input = OIIO::ImageInput::open("image." + lowerExtension(name), nullptr, &memory);
        if (!input) throw badImage(name, OIIO::geterror());
        const OIIO::ImageSpec& spec = input->spec();
        checkImageSize(spec.width, spec.height, bytes.size(), name, limits);
        if (spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 64 || spec.deep) {
            throw badImage(name, fmt::format("it declares {} layers of {} {}channels", spec.depth,
                                             spec.nchannels, spec.deep ? "deep " : ""));
        }
        if (beginsAsExr(bytes)) checkChannels(spec, name);
    }

    OIIO::Filesystem::IOMemReader memory;
    std::unique_ptr<OIIO::ImageInput> input;
};

/// 1 .. 8 as in TIFF and Exif: from 5 on the stored rows are columns.
int orientationOf(const OIIO::ImageInput& input) {
    const int orientation = input.spec().get_int_attribute("Orientation", 1);
    if (orientation < 1 || orientation > 8) return 1;
    // OpenImageIO 2.4 calls Radiance's +X +Y 6 and its -X -Y 8, which TIFF has the other way.
    const bool isSwapped =
        std::string_view(input.format_name()) == "hdr" && (orientation == 6 || orientation == 8);
    return isSwapped ? 14 - orientation : orientation;
}

/// Turns an image so that its first row is the top one and its first column the left one.
EncodedImage upright(const EncodedImage& stored, int orientation) {
    const bool swapped = orientation >= 5;
    const bool fromRight =
        orientation == 2 || orientation == 3 || orientation == 7 || orientation == 6;
    const bool fromBelow =
        orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    EncodedImage image{swapped ? stored.height : stored.width,
                       swapped ? stored.width : stored.height, stored.rgb};
    std::visit(
        [&](auto& rgb) {
            const auto& source = std::get<std::decay_t<decltype(rgb)>>(stored.rgb);
            std::size_t next = 0;
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    const int fromX = fromRight ? image.width - 1 - x : x;
                    const int fromY = fromBelow ? image.height - 1 - y : y;
                    const int column = swapped ? fromY : fromX;
                    const int row = swapped ? fromX : fromY;
                    const auto pixel = 3 * (static_cast<std::size_t>(row) *
                                                static_cast<std::size_t>(stored.width) +
                                            static_cast<std::size_t>(column));
                    for (std::size_t c = 0; c < 3; ++c) rgb[next++] = source[pixel + c];
                }
            }
        },
        image.rgb);
    return image;
}

}  // namespace

bool isImageName(const std::string& name) {
    static const std::set<std::string> kExtensions = imageExtensions();
    return kExtensions.contains(lowerExtension(name));
}

bool isLinearFormat(const std::string& name) {
    const std::string extension = lowerExtension(name);
    return extension == "exr" || extension == "hdr" || extension == "rgbe" || extension == "pfm";
}

void checkImageSize(int width, int height, std::size_t bytes, const std::string& name,
                    const ReadLimits& limits) {
    const bool hasSides =
        width >= 1 && height >= 1 && width <= kMaxImageSide && height <= kMaxImageSide;
    const std::size_t pixels =
        hasSides ? static_cast<std::size_t>(width) * static_cast<std::size_t>(height) : 0;
    if (!hasSides || pixels > kMaxExpansion * bytes) {
        throw badImage(name,
                       fmt::format("it declares {} x {} pixels in {} bytes", width, height, bytes));
    }
    if (pixels > limits.imagePixels) {
        throw std::runtime_error(fmt::format(
            "{}: has {} x {} pixels, and {} are allowed; --max-image-pixels allows more", name,
            width, height, limits.imagePixels));
    }
}

ImageSize imageSize(std::span<const char> bytes, const std::string& name,
                    const ReadLimits& limits) {
    if (const auto size = jpegSize(bytes, name, limits)) return *size;
    const OpenImage image(bytes, name, limits);
    return {image.input->spec().width, image.input->spec().height};
}

EncodedImage decodeImage(std::span<const char> bytes, const std::string& name,
                         const ReadLimits& limits) {
    if (bytes.empty()) throw badImage(name, "the file is empty");
    if (auto jpeg = decodeJpeg(bytes, name, limits)) return std::move(*jpeg);
    const OpenImage open(bytes, name, limits);
    const OIIO::ImageSpec& spec = open.input->spec();
    EncodedImage image{spec.width, spec.height, {}};
    const int orientation = orientationOf(*open.input);
    if (spec.format == OIIO::TypeDesc::UINT8) {
        image.rgb = readPixels<std::uint8_t>(*open.input, OIIO::TypeDesc::UINT8, name);
    } else {
        image.rgb = readPixels<float>(*open.input, OIIO::TypeDesc::FLOAT, name);
    }
    return orientation == 1 ? image : upright(image, orientation);
}

}  // namespace abrdf
