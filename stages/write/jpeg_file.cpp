// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/coded_file.h"
#include "stages/write/icc_profile.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <stdexcept>

namespace abrdf {

std::string jpegBytes(const CodedPicture& picture, int quality) {
    if (picture.bits != 8 || picture.channels != 3) {
        throw std::invalid_argument("JPEG holds 8 bits and no alpha; choose PNG");
    }
    if (picture.encoding && picture.encoding->curve == DisplayCurve::kPq) {
        throw std::invalid_argument("8-bit JPEG is too coarse for a PQ display; choose PNG");
    }
    OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::UINT8);
    spec.attribute("CompressionQuality", quality);
    spec.attribute("jpeg:subsampling", "4:4:4");
    for (const auto& [keyword, text] : picture.notes) {
        if (keyword == "Comment") spec.attribute("ImageDescription", text);
    }
    if (picture.encoding) {
        const std::string profile = iccProfile(*picture.encoding);
        spec.attribute("ICCProfile",
                       OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())),
                       profile.data());
    }
    std::vector<std::uint8_t> bytes(picture.codes.begin(), picture.codes.end());
    OIIO::Filesystem::IOVecOutput file;
    const auto jpeg = OIIO::ImageOutput::create("jpeg", &file);
    if (!jpeg || !jpeg->open("memory.jpg", spec) ||
        !jpeg->write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !jpeg->close()) {
        throw std::runtime_error(fmt::format("the JPEG cannot be encoded: {}",
                                             jpeg ? jpeg->geterror() : OIIO::geterror()));
    }
    return {file.buffer().begin(), file.buffer().end()};
}

}  // namespace abrdf
