// SPDX-License-Identifier: BSD-3-Clause
#include "stages/read/exr_header_check.h"

#include "stages/read/decode_image.h"
#include "stages/write/atlas_writer.h"
#include "tests/support/reader_faults.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A small atlas: tiled, with attributes of many types; with an estimate of two parts.
std::string atlasBytes(const fs::path& folder, bool hasEstimate = false) {
    AtlasHeader header;
    header.grid = AngularGrid(regularDirections(2, 3));
    header.layout = {AtlasKind::kAngular, 1, 1, 6, 6};
    header.interopId = "lin_rec709_scene";
    AtlasWriter writer(folder / "a.exr", header,
                       {PixelType::kHalf, Compression::kZip, false, {}, hasEstimate});
    writer.writeRows(0, 6, std::vector<Rgb>(36, Rgb{1, 2, 3}));
    writer.finish({});
    return bytesOf(folder / "a.exr");
}

/// Four bytes of `value` at `offset` behind an attribute's name and type.
std::string patched(std::string bytes, const std::string& attribute, std::size_t offset,
                    std::uint32_t value) {
    const std::size_t place = bytes.find(attribute);
    REQUIRE(place != std::string::npos);
    bytes.replace(place + attribute.size() + offset, 4, ByteWriter().put(value).bytes());
    return bytes;
}

/// The same in the last header of the file.
std::string patchedLast(const std::string& bytes, const std::string& attribute, std::size_t offset,
                        std::uint32_t value) {
    const std::size_t place = bytes.rfind(attribute);
    REQUIRE(place != std::string::npos);
    return bytes.substr(0, place) + patched(bytes.substr(place), attribute, offset, value);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a header that is true passes, one that was cut off does not") {
    const TemporaryFolder folder;
    const std::string whole = atlasBytes(folder.path());
    CHECK(beginsAsExr(whole));
    checkExrHeader(whole, "a.exr");
    for (std::size_t size = 4; size < 600; size += 23) {
        CHECK_THROWS_AS(checkExrHeader(whole.substr(0, size), "a.exr"), std::runtime_error);
    }
}

TEST_CASE("what a header declares beyond its file is refused before memory is taken") {
    const TemporaryFolder folder;
    const std::string whole = atlasBytes(folder.path());
    const std::string software = std::string("Software") + '\0' + "string" + '\0';
    const std::string tiles = std::string("tiles") + '\0' + "tiledesc" + '\0';
    const std::string window = std::string("dataWindow") + '\0' + "box2i" + '\0';
    for (const std::string& lie :
         {patched(whole, software, 0, 1500000000), patched(whole, software, 0, 0xffffffff),
          patched(whole, tiles, 4, 1 << 30), patched(whole, tiles, 8, 0),
          patched(whole, window, 12, 0x7fffffff), patched(whole, window, 16, 100000000)}) {
        CHECK_THROWS_AS(checkExrHeader(lie, "a.exr"), std::runtime_error);
        writeFile(folder.path() / "lie.exr", lie);
        CHECK(readFault(folder.path() / "lie.exr").find("lie.exr") != std::string::npos);
        CHECK_THROWS_AS(decodeImage(lie, "lie.exr"), std::runtime_error);
    }
}

TEST_CASE("every part of a file of several is checked, and all together") {
    const TemporaryFolder folder;
    const std::string whole = atlasBytes(folder.path(), true);
    checkExrHeader(whole, "a.exr");
    const std::string type = std::string("type") + '\0' + "string" + '\0';
    const std::string image = "tiledimage";
    const std::size_t end = whole.rfind(type) + type.size() + 4 + image.size() + 1;
    for (std::size_t size = 4; size < end; size += 23) {
        CHECK_THROWS_AS(checkExrHeader(whole.substr(0, size), "a.exr"), std::runtime_error);
    }
    const std::string tiles = std::string("tiles") + '\0' + "tiledesc" + '\0';
    const std::string window = std::string("dataWindow") + '\0' + "box2i" + '\0';
    const std::string chunks = std::string("chunkCount") + '\0' + "int" + '\0';
    // Lines of 65536 pixels, 256 of them at once; the tiles that it also declares are small enough.
    const std::string compression = std::string("compression") + '\0' + "compression" + '\0';
    std::string lines = patchedLast(whole, window, 12, 0xffff);
    lines = patchedLast(lines, tiles, 4, 0x10000);
    checkExrHeader(lines, "a.exr");
    lines[lines.rfind(compression) + compression.size() + 4] = 9;
    checkExrHeader(lines, "a.exr");
    lines.replace(lines.rfind(image), image.size(), "scanlineim");
    // Headers of parts, each with as many chunks as the file has room for.
    const std::size_t last = whole.rfind(std::string("channels") + '\0' + "chlist");
    const std::string part = patched(whole.substr(last, end - last), chunks, 4,
                                     static_cast<std::uint32_t>(whole.size() / 8));
    const std::string many = whole.substr(0, end) + part + part + whole.substr(end);
    for (const std::string& lie :
         {patchedLast(whole, tiles, 4, 1 << 30), patchedLast(whole, tiles, 8, 0),
          patchedLast(whole, window, 12, 0x7fffffff), patchedLast(whole, chunks, 4, 0x7fffffff),
          patchedLast(whole, chunks, 4, 0xffffffff), lines, many}) {
        CHECK_THROWS_AS(checkExrHeader(lie, "a.exr"), std::runtime_error);
        writeFile(folder.path() / "lie.exr", lie);
        CHECK(readFault(folder.path() / "lie.exr").find("lie.exr") != std::string::npos);
    }
}

TEST_SUITE_END();
