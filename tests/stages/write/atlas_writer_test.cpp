// SPDX-License-Identifier: BSD-3-Clause
#include "stages/write/atlas_writer.h"

#include "abrdf/output_file.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>

using namespace abrdf;

namespace {

AtlasHeader smallHeader(AtlasKind kind, int wide, int high) {
    AtlasHeader header;
    header.grid = AngularGrid(regularDirections(1, 5), regularDirections(1, 7));
    header.layout = {kind, wide, high, 5, 7};
    header.method = "measured";
    header.interopId = "lin_rec709_scene";
    return header;
}

/// Each value tells where it belongs, exactly in half.
Rgb valueOf(std::size_t texel, std::size_t pair) {
    return {static_cast<float>(texel), static_cast<float>(pair), 0.5F};
}

/// All pixels, row by row.
std::vector<Rgb> pixelsOf(const AtlasLayout& layout) {
    std::vector<Rgb> pixels;
    for (int y = 0; y < layout.height(); ++y) {
        for (int x = 0; x < layout.width(); ++x) {
            const AtlasSample s = layout.sampleFromPixel({x, y});
            pixels.push_back(
                valueOf(static_cast<std::size_t>(s.texelY * layout.texelsWide + s.texelX),
                        static_cast<std::size_t>(s.light * 7 + s.view)));
        }
    }
    return pixels;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("what is packed and written is looked up again from the header alone, on odd sizes") {
    const TemporaryFolder folder;
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        for (const PixelType type : {PixelType::kHalf, PixelType::kFloat}) {
            for (const auto& [wide, high] : {std::pair{1, 1}, {3, 2}, {2, 29}}) {
                const AtlasHeader header = smallHeader(kind, wide, high);
                const auto path = folder.path() / "a.exr";
                AtlasWriter writer(path, header, {type, Compression::kZip, false, {}});
                CHECK(writer.writeRows(0, header.layout.height(), pixelsOf(header.layout)) == 0);
                const std::uint64_t bytes = writer.finish({1, 2, 3, 4});
                CHECK(bytes == std::filesystem::file_size(path));
                const Atlas atlas = readAtlas(path);
                CHECK(atlas.header().counts.clamped == 1);
                CHECK(atlas.header().counts.nonfinite == 3);
                const AngularGrid& grid = atlas.header().grid;
                for (std::size_t t = 0; t < header.layout.texelCount(); ++t) {
                    for (std::size_t p = 0; p < 35; ++p) {
                        const auto x = static_cast<int>(t) % wide;
                        const auto y = static_cast<int>(t) / wide;
                        CHECK(atlas.at({x, y, static_cast<int>(p / 7), static_cast<int>(p % 7)}) ==
                              valueOf(t, p));
                        if (p % 7 == 0 || t == 0) {
                            const LightAndView pair = grid.pair(p);
                            CHECK(lookUp(atlas, pair.light, pair.view, x, y) == valueOf(t, p));
                        }
                    }
                }
                CHECK_THROWS_AS(lookUp(atlas, {}, {}, wide, 0), std::out_of_range);
            }
        }
    }
}

TEST_CASE(
    "the tiles of an interrupted file are continued to the same bytes, in every compression") {
    const TemporaryFolder folder;
    const AtlasHeader header = smallHeader(AtlasKind::kAngular, 30, 40);
    const std::vector<Rgb> pixels = pixelsOf(header.layout);
    for (const Compression compression :
         {Compression::kNone, Compression::kZips, Compression::kZip, Compression::kPiz}) {
        const auto whole = folder.path() / "whole.exr";
        const auto path = folder.path() / "a.exr";
        AtlasWriter once(whole, header, {PixelType::kHalf, compression, false, {}});
        once.writeRows(0, header.layout.height(), pixels);
        once.finish({});
        const int rowHeight = once.tileHeight(0);
        const auto row = static_cast<std::size_t>(rowHeight * header.layout.width());
        WrittenTiles written;
        {
            AtlasWriter first(path, header, {PixelType::kHalf, compression, true, {}});
            first.writeRows(0, rowHeight, std::span(pixels).first(row));
            written = first.written();
            // Appended, but not told of: a later run writes it again.
            first.writeRows(rowHeight, rowHeight, std::span(pixels).subspan(row, row));
        }
        CHECK_FALSE(std::filesystem::exists(path));
        AtlasWriter second(path, header, {PixelType::kHalf, compression, true, written});
        second.writeRows(rowHeight, header.layout.height() - rowHeight,
                         std::span(pixels).subspan(row));
        second.finish({});
        CHECK(bytesOf(path) == bytesOf(whole));
        CHECK_FALSE(std::filesystem::exists(partialBeside(path)));
        CHECK(readAtlas(path).at({29, 39, 4, 6}) == valueOf(39 * 30 + 29, 34));
        std::filesystem::remove(path);
    }
}

/// A number that tells its texel; one of them is not known.
std::vector<float> someEstimates(std::size_t count) {
    std::vector<float> values(count);
    for (std::size_t t = 0; t < count; ++t) values[t] = 0.1F * static_cast<float>(t + 1);
    values[count / 2] = std::numeric_limits<float>::quiet_NaN();
    return values;
}

/// Equal bits, so that NaN is NaN.
bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return std::ranges::equal(a, b, {}, std::bit_cast<std::uint32_t, float>,
                              std::bit_cast<std::uint32_t, float>);
}

/// Writes an atlas that tells its estimates, which `rows` has row by row.
void writeWithEstimates(const std::filesystem::path& path, const AtlasHeader& header,
                        const AtlasWriterOptions& options, const std::vector<float>& rows) {
    AtlasWriter writer(path, header, options);
    std::vector<float> ordered(rows.size());
    texelOrderOf(header.layout).reorder<float>(rows, ordered);
    const std::size_t middle = ordered.size() / 2;
    writer.keepEstimates(middle, std::span(ordered).subspan(middle));
    writer.keepEstimates(0, std::span(ordered).first(middle));
    CHECK(sameBits(writer.estimates(), rows));
    writer.writeRows(0, header.layout.height(), pixelsOf(header.layout));
    const std::uint64_t bytes = writer.finish({1, 2, 3, 4});
    CHECK(bytes == std::filesystem::file_size(path));
}

TEST_CASE("estimates are part 1, a pixel a texel, for OpenEXR and for OpenImageIO") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        for (const Compression compression : {Compression::kNone, Compression::kZip}) {
            for (const auto& [wide, high] : {std::pair{1, 1}, {30, 40}, {11, 3}}) {
                const AtlasHeader header = smallHeader(kind, wide, high);
                const std::vector<float> rows = someEstimates(header.layout.texelCount());
                writeWithEstimates(path, header, {PixelType::kHalf, compression, false, {}, true},
                                   rows);
                CHECK(sameBits(readEstimates(path), rows));
                const Atlas atlas = readAtlas(path);
                CHECK(atlas.header().counts.nonfinite == 3);
                CHECK(atlas.at({wide - 1, high - 1, 4, 6}) ==
                      valueOf(header.layout.texelCount() - 1, 34));

                Imf::MultiPartInputFile exr(path.c_str(), 0, false);
                REQUIRE(exr.parts() == 2);
                CHECK(exr.header(0).name() == "rgb");
                CHECK(exr.header(1).name() == "estimate");
                CHECK(exr.partComplete(0));
                CHECK(exr.partComplete(1));
                CHECK(exr.header(1).chunkCount() == 1);
                CHECK(exr.header(1).compression() == Imf::NO_COMPRESSION);

                std::vector<float> values(rows.size());
                const auto oiio = OIIO::ImageInput::open(path.string());
                REQUIRE(oiio);
                REQUIRE(oiio->seek_subimage(1, 0));
                CHECK(oiio->spec().width == wide);
                CHECK(oiio->spec().height == high);
                CHECK(oiio->spec().channelnames == std::vector<std::string>{"deltaE"});
                REQUIRE(oiio->read_image(1, 0, 0, 1, OIIO::TypeFloat, values.data()));
                CHECK(sameBits(values, rows));
                CHECK_FALSE(oiio->seek_subimage(2, 0));
                std::vector<Rgb> pixels(pixelsOf(header.layout).size());
                REQUIRE(oiio->read_image(0, 0, 0, 3, OIIO::TypeFloat, pixels.data()));
                CHECK(pixels == pixelsOf(header.layout));
            }
        }
    }
}

TEST_CASE("a file without estimates has one part, and none are read from it") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    AtlasWriter writer(path, smallHeader(AtlasKind::kAngular, 2, 1), {});
    CHECK(writer.estimates().empty());
    writer.writeRows(0, 5, std::vector<Rgb>(70));
    writer.finish({});
    CHECK(readEstimates(path).empty());
    // A version that the oldest readers take: 2, tiled.
    CHECK(bytesOf(path).substr(4, 4) == std::string("\2\2\0\0", 4));
}

TEST_CASE("what was never told is NaN; the tiles of an interrupted file stand where they stood") {
    const TemporaryFolder folder;
    const AtlasHeader header = smallHeader(AtlasKind::kAngular, 30, 40);
    const std::vector<Rgb> pixels = pixelsOf(header.layout);
    const std::vector<float> rows = someEstimates(header.layout.texelCount());
    AtlasWriterOptions options{PixelType::kHalf, Compression::kZip, false, {}, true};
    writeWithEstimates(folder.path() / "whole.exr", header, options, rows);
    const auto path = folder.path() / "a.exr";
    options.resumable = true;
    std::size_t row = 0;
    int rowHeight = 0;
    {
        AtlasWriter first(path, header, options);
        rowHeight = first.tileHeight(0);
        row = static_cast<std::size_t>(rowHeight * header.layout.width());
        first.writeRows(0, rowHeight, std::span(pixels).first(row));
        options.written = first.written();
        first.writeRows(rowHeight, rowHeight, std::span(pixels).subspan(row, row));
    }
    AtlasWriter second(path, header, options);
    CHECK(std::ranges::all_of(second.estimates(), [](float e) { return std::isnan(e); }));
    std::vector<float> ordered(rows.size());
    second.order().reorder<float>(rows, ordered);
    second.keepEstimates(0, ordered);
    second.writeRows(rowHeight, header.layout.height() - rowHeight, std::span(pixels).subspan(row));
    second.finish({1, 2, 3, 4});
    CHECK(bytesOf(path) == bytesOf(folder.path() / "whole.exr"));
}

TEST_CASE("a half never becomes infinite: it is cut and counted") {
    const TemporaryFolder folder;
    AtlasHeader header = smallHeader(AtlasKind::kAngular, 1, 1);
    std::vector<Rgb> pixels(35, Rgb{1, 2, 3});
    pixels[4].g = 1e6F;
    CHECK_FALSE(fitsHalf(pixels));
    AtlasWriter writer(folder.path() / "a.exr", header,
                       {PixelType::kHalf, Compression::kNone, false, {}});
    CHECK(writer.writeRows(0, 5, pixels) == 1);
    writer.finish({});
    CHECK(readAtlas(folder.path() / "a.exr").at({0, 0, 0, 4}).g == 65504);
}

TEST_CASE("without finish() nothing is left behind and an old file is intact") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    std::ofstream(path) << "old";
    {
        const AtlasHeader header = smallHeader(AtlasKind::kAngular, 1, 1);
        AtlasWriter writer(path, header, {});
        writer.writeRows(0, 5, std::vector<Rgb>(35));
    }
    CHECK(bytesOf(path) == "old");
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
    {
        OutputFile file(path);
        file.write(std::string("new"));
    }
    CHECK(bytesOf(path) == "old");
    writeWholeFile(path, "new");
    CHECK(bytesOf(path) == "new");
    CHECK_THROWS_AS(checkOutputPath(folder.path()), std::runtime_error);
    CHECK_THROWS_AS(checkOutputPath(folder.path() / "no" / "a.exr"), std::runtime_error);
}

TEST_CASE("a device is not taken for an output file") {
    CHECK_THROWS_AS(checkOutputPath("/dev/full"), std::runtime_error);
}

TEST_CASE("files that are no atlas are refused by name") {
    const TemporaryFolder folder;
    const auto path = folder.path() / "a.exr";
    std::ofstream(path) << "no picture";
    CHECK_FALSE(isAtlas(path));
    CHECK_THROWS_AS(readAtlasHeader(path), std::runtime_error);
}

TEST_SUITE_END();
