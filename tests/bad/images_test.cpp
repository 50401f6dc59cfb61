// SPDX-License-Identifier: BSD-3-Clause
//
// Images that are cut, huge, of other channels, or no images at all.
#include "tests/bad/bad_images.h"
#include "tests/bad/bad_input.h"
#include "tests/support/small_files.h"

#include <doctest/doctest.h>

#include <limits>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A stack of this one image.
BadInput oneImage(const std::string& what, const std::string& extension, const std::string& bytes,
                  const std::string& says, int status = 1, const std::string& options = "") {
    return {what, [=](const fs::path& folder) { put(folder / stackImage(extension), bytes); },
            "inspect stack " + options, status, says};
}

std::string cut(const std::string& bytes, double share) {
    return bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
}

OddImage codes(const std::string& extension, int bits = 8) {
    OddImage image;
    image.extension = extension;
    image.bits = bits;
    return image;
}

OddImage exrWith(const std::vector<std::string>& channels) {
    OddImage image;
    image.channels = channels;
    return image;
}

/// `size` bytes at `place` of an OpenEXR's attribute replaced.
std::string patched(std::string bytes, const std::string& attribute, std::size_t offset,
                    std::uint32_t value) {
    return bytes.replace(bytes.find(attribute) + attribute.size() + offset, 4,
                         ByteWriter().put(value).bytes());
}

std::string text(const char* name, const char* type) {
    return std::string(name) + '\0' + type + '\0';
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("bad input: JPEG, PNG, TIFF and HDR") {
    const std::string jpeg = bytesOf(codes("jpg"));
    const std::string png = bytesOf(codes("png"));
    std::string lyingJpeg = jpeg;
    lyingJpeg.replace(lyingJpeg.find("\xff\xc0") + 5, 4, "\x7f\xff\x7f\xff");
    std::string lyingTiff = bytesOf(codes("tif"));
    lyingTiff.replace(0, 2, "MM");
    std::string wrongSum = png;
    wrongSum[wrongSum.find("IDAT") + 6] ^= 1;
    checkBadInputs({
        oneImage("an empty file", "jpg", "", "is empty"),
        oneImage("a text", "jpg", "no photograph", "not a whole image"),
        oneImage("the page of a server that was down", "jpg", "<html>503</html>",
                 "not a whole image"),
        oneImage("a JPEG without its end", "jpg", cut(jpeg, 0.9), "not a whole image"),
        oneImage("a JPEG's header alone", "jpg", cut(jpeg, 0.3), "not a whole image"),
        oneImage("a JPEG of 32767 x 32767", "jpg", lyingJpeg, "declares 32767 x 32767 pixels"),
        oneImage("a JPEG of four inks", "jpg", cmykJpeg(), "complete +true", 0),
        oneImage("a JPEG of 600 scans", "jpg", jpegOfScans(600), "scans"),
        oneImage("a JPEG that is called PNG", "png", jpeg, "complete +true", 0),
        oneImage("a PNG without its end", "png", cut(png, 0.7), "not a whole image"),
        oneImage("a PNG whose checksum is wrong", "png", wrongSum, "not a whole image"),
        oneImage("a PNG of 2^31 - 1 pixels a side", "png", withPngSize(png, 0x7fffffff, 0x7fffffff),
                 "not a whole image"),
        oneImage("a PNG of 2^31 pixels a side", "png", withPngSize(png, 0x80000000, 0x80000000),
                 "not a whole image"),
        oneImage("a PNG of 30000 x 30000 in some bytes", "png", withPngSize(png, 30000, 30000),
                 "declares 30000 x 30000 pixels in"),
        oneImage("a PNG of no pixels", "png", withPngSize(png, 0, 0), "not a whole image"),
        oneImage("a PNG that unpacks to 81 million pixels", "png", blackPng(9000),
                 "9000 x 9000 pixels, and 67108864 are allowed; --max-image-pixels"),
        oneImage("a bound of one's own", "png", blackPng(100), "100 x 100 pixels, and 9999 are", 1,
                 "--max-image-pixels 9999"),
        oneImage("a file above a bound of one's own", "png", blackPng(100),
                 "too large for an image.*--max-file-size", 1, "--max-file-size 64"),
        oneImage("a PNG of 16 bits", "png", bytesOf(codes("png", 16)), "complete +true", 0),
        oneImage("a TIFF that says it is of the other endianness", "tif", lyingTiff,
                 "not a whole image"),
        oneImage("a TIFF without its end", "tif", cut(bytesOf(codes("tif")), 0.5),
                 "not a whole image"),
        oneImage("an HDR of 2^31 rows", "hdr", hdrBytes("-Y 2147483647 +X 2", 6),
                 "not a whole image"),
        oneImage("an HDR without its end", "hdr", hdrBytes("-Y 20 +X 30", 6), "not a whole image"),
    });
}

TEST_CASE("bad input: OpenEXR") {
    const std::string exr = bytesOf(OddImage{});
    OddImage deep;
    deep.deep = true;
    OddImage parts;
    parts.parts = 2;
    OddImage notANumber;
    notANumber.value = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::string> seventy = {"R", "G", "B"};
    while (seventy.size() < 70) seventy.push_back("extra" + std::to_string(seventy.size()));
    std::string swapped = exr;
    swapped.replace(0, 4, "\x01\x31\x2f\x76");
    const std::string window = text("dataWindow", "box2i");
    checkBadInputs({
        oneImage("without green", "exr", bytesOf(exrWith({"R", "B"})),
                 "its channels are R, B, and"),
        oneImage("without red, green and blue", "exr", bytesOf(exrWith({"X", "Y", "Z"})),
                 "its channels are X, Y, Z, and R, G and B"),
        oneImage("depth and normals alone", "exr", bytesOf(exrWith({"Z", "N.x", "N.y", "N.z"})),
                 "its channels are"),
        oneImage("one channel is a grey image", "exr", bytesOf(exrWith({"Y"})), "complete +true",
                 0),
        oneImage("colour and depth", "exr", bytesOf(exrWith({"R", "G", "B", "A", "Z"})),
                 "complete +true", 0),
        oneImage("70 channels", "exr", bytesOf(exrWith(seventy)), "70 channels"),
        oneImage("a deep image", "exr", bytesOf(deep), "deep"),
        oneImage("two parts, of which the first counts", "exr", bytesOf(parts), "complete +true",
                 0),
        oneImage("every second pixel sampled", "exr", subsampledExr(),
                 "Subsampled channels are not supported"),
        oneImage("NaN in every pixel", "exr", bytesOf(notANumber), "nonfinite +12", 0),
        oneImage("the magic number of the other endianness", "exr", swapped, "not a whole image"),
        oneImage("without its end", "exr", cut(exr, 0.95), "not a whole image"),
        oneImage("a header alone", "exr", cut(exr, 0.5), "is damaged or cut"),
        oneImage("2^31 columns", "exr", patched(exr, window, 12, 0x7fffffff), "declares"),
        oneImage("a million rows", "exr", patched(exr, window, 16, 1000000), "declares"),
        oneImage("a window that ends before it begins", "exr", patched(exr, window, 12, 0xfffffff0),
                 "declares"),
        oneImage("an attribute of gigabytes", "exr",
                 patched(exr, text("compression", "compression"), 0, 0x70000000), "damaged"),
    });
}

TEST_SUITE_END();
