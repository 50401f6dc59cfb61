// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/preview/preview.h"

#include "color/delta_e.h"
#include "pipeline/convert/convert.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Vector operator*(const Matrix& m, const Vector& v) {
    Vector result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) result[i] += m[i][j] * v[j];
    }
    return result;
}

// The twenty-four patches of the ColorChecker Classic as sRGB codes, of BabelColor's averages.
constexpr std::array<std::array<int, 3>, 24> kChecker{{
    {115, 82, 68},   {194, 150, 130}, {98, 122, 157}, {87, 108, 67},   {133, 128, 177},
    {103, 189, 170}, {214, 126, 44},  {80, 91, 166},  {193, 90, 99},   {94, 60, 108},
    {157, 188, 64},  {224, 163, 46},  {56, 61, 150},  {70, 148, 73},   {175, 54, 60},
    {231, 199, 31},  {187, 86, 149},  {8, 133, 161},  {243, 243, 242}, {200, 200, 200},
    {160, 160, 160}, {122, 122, 121}, {85, 85, 85},   {52, 52, 52},
}};

// ACES' published matrices (Academy TB-2014-004, Bradford from D60), in their ten digits.
constexpr Matrix kAp1FromRec709{{{0.6130974024, 0.3395231462, 0.0473794514},
                                 {0.0701937225, 0.9163538791, 0.0134523985},
                                 {0.0206155929, 0.1095697729, 0.8698146342}}};
constexpr Matrix kRec709FromAp1{{{1.7050509880, -0.6217921206, -0.0832588675},
                                 {-0.1302564175, 1.1408047365, -0.0105483191},
                                 {-0.0240033568, -0.1289689761, 1.1529723329}}};
// IEC 61966-2-1.
constexpr Matrix kXyzFromRec709{{{0.4123907993, 0.3575843394, 0.1804807884},
                                 {0.2126390059, 0.7151686788, 0.0721923154},
                                 {0.0193308187, 0.1191947798, 0.9505321522}}};

double decoded(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

/// CIE L*a*b* of an sRGB code in doubles alone.
Lab labOf(const Vector& code) {
    const Vector xyz =
        kXyzFromRec709 * Vector{decoded(code[0]), decoded(code[1]), decoded(code[2])};
    const Vector white = kXyzFromRec709 * Vector{1, 1, 1};
    const auto f = [](double t) {
        return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
    };
    const double x = f(xyz[0] / white[0]);
    const double y = f(xyz[1] / white[1]);
    const double z = f(xyz[2] / white[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

struct Read {
    int width = 0;
    int channels = 0;
    std::vector<float> values;
};

Read readPicture(const fs::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE_MESSAGE(input, file);
    const OIIO::ImageSpec& spec = input->spec();
    Read read{spec.width, spec.nchannels, {}};
    read.values.resize(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
    REQUIRE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, read.values.data()));
    return read;
}

/// Mean codes of a square of the picture around (x, y).
Vector meanAround(const Read& picture, int x, int y, int reach) {
    Vector sum{};
    for (int row = y - reach; row <= y + reach; ++row) {
        for (int column = x - reach; column <= x + reach; ++column) {
            const auto at =
                static_cast<std::size_t>((row * picture.width + column) * picture.channels);
            for (std::size_t c = 0; c < 3; ++c)
                sum[c] += static_cast<double>(picture.values[at + c]);
        }
    }
    const double count = (2 * reach + 1) * (2 * reach + 1);
    return {sum[0] / count, sum[1] / count, sum[2] / count};
}

/// A flat picture, lit and seen from straight above.
PreviewOptions flat(const fs::path& atlas, const fs::path& output) {
    PreviewOptions options;
    options.atlas = atlas;
    options.output = output;
    options.kind = PreviewKind::kPlane;
    options.width = options.height = 120;
    options.cameraElevation = 90;
    options.lights = {{0, radiansFromDegrees(90), 1}};
    options.tiles = 1;
    options.display = {"sRGB - Display", "Un-tone-mapped", ""};
    options.colorConfig = fs::path(ABRDF_SOURCE_DIR) / "color/config.ocio";
    return options;
}

fs::path greyAtlas(const TemporaryFolder& folder, float grey) {
    const fs::path file = folder.path() / "grey.exr";
    writeAtlas(file, syntheticAtlas(AngularGrid(regularDirections(2, 4)), 1, 1,
                                    [&](const LightAndView& p, int, int) {
                                        return lambertianWithGloss(p, {grey, grey, grey}, 0, 1);
                                    }));
    return file;
}

std::string outputOf(const std::string& command) {
    const TemporaryFolder folder;
    const fs::path out = folder.path() / "out";
    if (std::system((command + " > " + out.string() + " 2>&1").c_str()) != 0) return {};
    return bytesOf(out);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a colour checker goes from ACEScg through an atlas and a preview to sRGB unharmed") {
    const TemporaryFolder folder;
    // Four columns and six rows of patches, each of 4 x 4 texels, so that middles are pure.
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(2, 4));
    btf.width = 16;
    btf.height = 24;
    const auto ap1Of = [](int column, int row) {
        Vector light{};
        for (std::size_t c = 0; c < 3; ++c) {
            light[c] = decoded(kChecker[static_cast<std::size_t>(4 * row + column)][c] / 255.0);
        }
        return kAp1FromRec709 * light;
    };
    btf.value = [&](const LightAndView& p, int x, int y) {
        const Vector c = ap1Of(x / 4, y / 4);
        return static_cast<float>(std::cos(p.light.theta)) *
               Rgb{static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
    };
    writeSyntheticBtf(folder.path() / "btf", btf);
    ConvertOptions job;
    job.input.input = folder.path() / "btf";
    job.input.inputSpace = "ACEScg";
    job.input.colorConfig = fs::path(ABRDF_SOURCE_DIR) / "color/config.ocio";
    job.output = folder.path() / "checker.exr";
    job.outputSpace = "ACEScg";
    job.method.name = "measured";
    job.texels = {0, 0};
    job.pixel = PixelChoice::kFloat;
    const auto made = convert(job, {});
    CHECK(made["color"]["conversions"].size() == 1);
    CHECK(made["color"]["conversions"][0]["from"] == "ACEScg");
    CHECK(readAtlasHeader(job.output).conversion == "ACEScg -> ACEScg");

    PreviewOptions options = flat(job.output, folder.path() / "checker.png");
    options.width = options.height = 480;
    // The picture's half side on the ground, where the square's is 0.75.
    const double halfSide = 0.88 * 1.06 / std::cos(radiansFromDegrees(12.5));
    const auto pixelOf = [&](double place) {
        return static_cast<int>(240 * (1 + 1.5 * (place - 0.5) / halfSide));
    };
    for (const int bits : {8, 16}) {
        options.bits = bits;
        const auto report = preview(options, {});
        CHECK(report["color"]["conversions"][0]["from"] == "ACEScg");
        CHECK(report["color"]["encoding"] == "sRGB");
        const Read picture = readPicture(options.output);
        double worst = 0;
        for (int row = 0; row < 6; ++row) {
            for (int column = 0; column < 4; ++column) {
                Vector expected = kRec709FromAp1 * ap1Of(column, row);
                for (double& c : expected) c = srgbEncoded(c);
                // Six texels repeat one and a half times over as many columns of patches.
                const Vector found =
                    meanAround(picture, pixelOf((column + 0.5) / 6), pixelOf((row + 0.5) / 6), 10);
                const double off = deltaE2000(labOf(found), labOf(expected));
                CAPTURE(column);
                CAPTURE(row);
                CHECK(off < 0.1);
                worst = std::max(worst, off);
            }
        }
        MESSAGE("worst Delta E 2000 of the patches at " << bits << " bits: " << worst);
    }
}

TEST_CASE("a PQ still has 16 bits, says so in cICP, and holds the light it is meant to") {
    const TemporaryFolder folder;
    PreviewOptions options = flat(greyAtlas(folder, 0.5F), folder.path() / "hdr.png");
    options.display = {"Rec.2100-PQ - Display", "Un-tone-mapped", ""};
    options.exposure = 8;
    const auto report = preview(options, {});
    CHECK(report["output"]["bits"] == 16);
    const std::string bytes = bytesOf(options.output);
    CHECK(contains(bytes, std::string("cICP\x09\x10\0\1", 8)));
    const Vector code = meanAround(readPicture(options.output), 60, 60, 5);
    // SMPTE ST 2084 of 4 times white, which is 100 nits.
    const double m = std::pow(code[1], 32.0 / 2523);
    const double nits =
        10000 * std::pow((m - 107.0 / 128) / (2413.0 / 128 - 2392.0 / 128 * m), 16384.0 / 2610);
    CHECK(nits == doctest::Approx(400).epsilon(0.01));
    options.bits = 8;
    CHECK(contains(faultOf<std::invalid_argument>([&] { preview(options, {}); }), "--bits 16"));
    options.bits = 0;
    options.output = folder.path() / "hdr.jpg";
    CHECK_FALSE(faultOf<std::invalid_argument>([&] { preview(options, {}); }).empty());
}

TEST_CASE("an EXR picture keeps the light, says its space, and has depth and normals as data") {
    const TemporaryFolder folder;
    PreviewOptions options = flat(greyAtlas(folder, 0.5F), folder.path() / "a.exr");
    options.display = {};
    options.outputSpace = "ACEScg";
    options.exposure = 20;
    const auto report = preview(options, {});
    CHECK(report["output"]["color_space"] == "ACEScg");
    const auto input = OIIO::ImageInput::open(options.output.string());
    REQUIRE(input);
    CHECK(input->spec().nchannels == 4);
    CHECK(input->spec().get_string_attribute("colorInteropID") == "lin_ap1_scene");
    std::vector<float> pixels(120 * 120 * 4);
    REQUIRE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, pixels.data()));
    const float* middle = &pixels[static_cast<std::size_t>(60 * 120 + 60) * 4];
    CHECK(middle[0] == doctest::Approx(10).epsilon(2e-3));
    CHECK(middle[3] == 1);
    REQUIRE(input->seek_subimage(1, 0));
    CHECK(input->spec().channelnames[0] == "Z");
    CHECK(input->spec().get_string_attribute("colorInteropID") == "data");
    REQUIRE(input->read_image(1, 0, 0, 1, OIIO::TypeDesc::FLOAT, pixels.data()));
    CHECK(pixels[60 * 120 + 60] ==
          doctest::Approx(0.88 * 1.06 / std::sin(radiansFromDegrees(12.5))).epsilon(1e-3));
    REQUIRE(input->seek_subimage(2, 0));
    REQUIRE(input->read_image(2, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
    CHECK(pixels[static_cast<std::size_t>(60 * 120 + 60) * 3 + 1] == 1);
}

TEST_CASE("oiiotool and exrheader see the space of atlases and pictures") {
    if (outputOf("which oiiotool exrheader").empty()) {
        MESSAGE("oiiotool or exrheader is absent (openimageio-tools, openexr): left out");
        return;
    }
    const TemporaryFolder folder;
    PreviewOptions options = flat(greyAtlas(folder, 0.5F), folder.path() / "a.exr");
    options.display = {};
    options.outputSpace = "ACEScg";
    preview(options, {});
    const std::string picture = "'" + options.output.string() + "'";
    const std::string atlas = "'" + options.atlas.string() + "'";
    CHECK(contains(outputOf("oiiotool --info -v " + picture), "colorInteropID: \"lin_ap1_scene\""));
    CHECK(contains(outputOf("oiiotool --info -v " + picture), "chromaticities: 0.713"));
    CHECK(contains(outputOf("exrheader " + picture), "red   (0.713 0.293)"));
    CHECK(contains(outputOf("exrheader " + atlas), "red   (0.64 0.33)"));
    CHECK(contains(outputOf("exrheader " + atlas),
                   "colorInteropID (type string): \"lin_rec709_scene\""));
    CHECK(
        contains(outputOf("oiiotool --info -v " + atlas), "colorInteropID: \"lin_rec709_scene\""));
}

TEST_CASE("Delta E of a sheet is data: the space of the colours beside it does not change it") {
    const TemporaryFolder folder;
    const fs::path atlas = greyAtlas(folder, 0.5F);
    const fs::path reference = folder.path() / "reference.exr";
    writeAtlas(reference,
               syntheticAtlas(AngularGrid(regularDirections(2, 4)), 1, 1,
                              [](const LightAndView& p, int, int) {
                                  return lambertianWithGloss(p, {0.6F, 0.4F, 0.5F}, 0, 1);
                              }));
    std::vector<std::vector<float>> deltaE;
    for (const char* space : {"ACEScg", "Linear Rec.709 (sRGB)"}) {
        PreviewOptions options = flat(atlas, folder.path() / "sheet.exr");
        options.kind = PreviewKind::kSheet;
        options.display = {};
        options.reference = reference;
        options.outputSpace = space;
        preview(options, {});
        const auto input = OIIO::ImageInput::open(options.output.string());
        REQUIRE(input->seek_subimage(2, 0));
        CHECK(input->spec().channelnames[0] == "deltaE");
        deltaE.emplace_back(64);
        REQUIRE(input->read_image(2, 0, 0, 1, OIIO::TypeDesc::FLOAT, deltaE.back().data()));
    }
    CHECK(deltaE[0] == deltaE[1]);
    const double expected =
        deltaE76(labFromLinearRec709({0.5F, 0.5F, 0.5F}), labFromLinearRec709({0.6F, 0.4F, 0.5F}));
    CHECK(static_cast<double>(deltaE[0][0]) == doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("what cannot be is said before anything is written, with the way out") {
    const TemporaryFolder folder;
    const PreviewOptions good = flat(greyAtlas(folder, 0.5F), folder.path() / "a.png");
    const auto with = [&](const auto& change) {
        PreviewOptions options = good;
        change(options);
        return faultOf<std::exception>([&] { preview(options, {}); });
    };
    CHECK(contains(with([](auto& o) { o.output.replace_extension(".tga"); }),
                   "use .exr, .png or .jpg"));
    CHECK(contains(with([](auto& o) { o.output.replace_extension(".exr"); }), "scene-linear"));
    CHECK(contains(with([](auto& o) { o.outputSpace = "ACEScg"; }), "--output-space is for .exr"));
    CHECK(contains(with([](auto& o) { o.display.view = "Filmc"; }), "no view"));
    CHECK(contains(with([](auto& o) { o.environment = "/no/such.hdr"; }), "/no/such.hdr"));
    CHECK(contains(with([](auto& o) { o.samples = 0; }), "samples"));
    CHECK(contains(with([](auto& o) { o.atlas = "nothing.exr"; }), "nothing.exr"));
    CHECK(contains(with([](auto& o) {
                       o.kind = PreviewKind::kSheet;
                       o.pairs = {"1,2,3"};
                   }),
                   "THETA_I"));
    CHECK_FALSE(fs::exists(good.output));
}

TEST_CASE("a draft comes first in the same place, and an environment file lights as it says") {
    const TemporaryFolder folder;
    PreviewOptions options = flat(greyAtlas(folder, 0.5F), folder.path() / "a.exr");
    options.display = {};
    options.draft = true;
    // Fine enough for the cosine.
    writeAtlas(
        options.atlas,
        syntheticAtlas(AngularGrid(ubo81Directions()), 1, 1, [](const LightAndView& p, int, int) {
            return lambertianWithGloss(p, {0.5F, 0.5F, 0.5F}, 0, 1);
        }));
    options.lights.clear();
    options.environment = (folder.path() / "white.exr").string();
    std::vector<float> white(32 * 16 * 3, 2.0F);
    OIIO::ImageSpec spec(32, 16, 3, OIIO::TypeDesc::FLOAT);
    spec.attribute("colorInteropID", "lin_ap1_scene");
    const auto output = OIIO::ImageOutput::create(options.environment);
    REQUIRE(output->open(options.environment, spec));
    REQUIRE(output->write_image(OIIO::TypeDesc::FLOAT, white.data()));
    REQUIRE(output->close());
    const auto report = preview(options, {});
    CHECK(report["time"].contains("draft"));
    CHECK(report["color"]["conversions"][1]["from"] == "ACEScg");
    CHECK(meanAround(readPicture(options.output), 60, 60, 3)[1] ==
          doctest::Approx(1).epsilon(0.02));
}

TEST_SUITE_END();
