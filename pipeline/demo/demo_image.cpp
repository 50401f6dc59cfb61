// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/demo/demo_image.h"

#include "color/known_space.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace abrdf {

namespace {

// A space is stated by its name in the config, so that a user's own $OCIO may define it.
ColorTransform encodingOf(DemoFormat format) {
    const std::string linear(ocioName(KnownSpace::kLinearRec709));
    const bool isJpeg = format == DemoFormat::kJpeg;
    const std::string encoded = isJpeg ? std::string(ocioName(KnownSpace::kSrgbTexture)) : linear;
    return ColorConfig::load().transform(linear, encoded);
}

OIIO::ImageSpec jpegSpec(int size) {
    OIIO::ImageSpec spec(size, size, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("jpeg:subsampling", "4:4:4");
    return spec;
}

OIIO::ImageSpec exrSpec(int size) {
    OIIO::ImageSpec spec(size, size, 3, OIIO::TypeDesc::HALF);
    spec.attribute("Compression", "zip");
    spec.attribute("DateTime", "2020:01:01 00:00:00");  // OpenImageIO would state the true time.
    const Primaries p = primaries(KnownSpace::kLinearRec709);
    const std::array<float, 8> chromaticities = {p.red[0],  p.red[1],  p.green[0], p.green[1],
                                                 p.blue[0], p.blue[1], p.white[0], p.white[1]};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                   chromaticities.data());
    spec.attribute("colorInteropID", std::string(interopId(KnownSpace::kLinearRec709)));
    return spec;
}

/// The bytes of the image's file. In memory, as libjpeg ends the whole program where a disk is
/// full.
std::vector<unsigned char> encoded(const OIIO::ImageSpec& spec, const std::string& name,
                                   std::span<const Rgb> colors) {
    OIIO::Filesystem::IOVecOutput bytes;
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(name);
    if (!output) throw std::runtime_error(fmt::format("{}: {}", name, OIIO::geterror()));
    if (!output->set_ioproxy(&bytes) || !output->open(name, spec) ||
        !output->write_image(OIIO::TypeDesc::FLOAT, colors.data()) || !output->close()) {
        throw std::runtime_error(fmt::format("{}: cannot be encoded: {}; is OpenImageIO complete?",
                                             name, output->geterror()));
    }
    return bytes.buffer();
}

}  // namespace

std::string_view extension(DemoFormat format) {
    return format == DemoFormat::kJpeg ? "jpg" : "exr";
}

DemoImageWriter::DemoImageWriter(int size, DemoFormat format)
    : size_(size), format_(format), encoding_(encodingOf(format)) {}

void DemoImageWriter::write(const std::filesystem::path& file, std::span<Rgb> colors) const {
    assert(colors.size() == static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_));
    if (!encoding_.isIdentity()) encoding_.apply(colors);
    const OIIO::ImageSpec spec = format_ == DemoFormat::kJpeg ? jpegSpec(size_) : exrSpec(size_);
    const std::vector<unsigned char> bytes = encoded(spec, file.string(), colors);

    std::FILE* stream = std::fopen(file.c_str(), "wb");
    bool written = stream != nullptr;
    if (stream != nullptr) {
        written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
        const int error = errno;
        // A full disk may show itself only here.
        if (std::fclose(stream) != 0) {
            written = false;
        } else if (!written) {
            errno = error;
        }
    }
    if (!written) {
        throw std::runtime_error(fmt::format("{}: cannot be written: {}; see to it and run again",
                                             file.string(), std::strerror(errno)));
    }
}

}  // namespace abrdf
