// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/export/export.h"

#include "pipeline/convert/convert.h"
#include "stages/read/atlas_reader.h"
#include "stages/read/btf_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/small_files.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

double material(const LightAndView& p) {
    return std::cos(p.light.theta) * (1 + 0.25 * std::cos(p.light.phi - p.view.phi) *
                                              std::sin(p.light.theta) * std::sin(p.view.theta));
}

void writeStack(const fs::path& folder) {
    SyntheticBtf btf;
    btf.width = 3;
    btf.height = 2;
    btf.value = [](const LightAndView& p, int x, int y) {
        // The mean over the texels is 1.
        const auto v = static_cast<float>(material(p) * (0.75 + 0.25 * x) * (0.5 + y));
        return Rgb{v, v / 2, v / 4};
    };
    writeSyntheticBtf(folder, btf);
}

nlohmann::ordered_json converted(const fs::path& input, const fs::path& output,
                                 const std::string& grid, AtlasKind layout, const char* texels) {
    ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "measured";
    options.grid = grid;
    options.layout = layout;
    options.texels = texelsFromName(texels);
    options.pixel = PixelChoice::kFloat;
    return convert(options, {});
}

nlohmann::ordered_json exported(const fs::path& input, const std::string& format,
                                const fs::path& output, std::optional<TexelPlace> texel = {},
                                int azimuths = ExportOptions().azimuths) {
    ExportJob job;
    job.texel = texel;
    job.options.azimuths = azimuths;
    job.input.input = input;
    job.format = format;
    job.output = output;
    return exportBrdf(job, {});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("an atlas of either layout is an input like the stack that it was made of") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    converted(folder.path() / "btf", folder.path() / "first.exr", "input", AtlasKind::kAngular,
              "full");
    for (const auto layout : {AtlasKind::kSpatial, AtlasKind::kAngular}) {
        const fs::path again = folder.path() / "again.exr";
        const auto report = converted(folder.path() / "first.exr", again, "input", layout, "full");
        CHECK(report["input"]["format"] == "abrdf atlas");
        const Atlas a = readAtlas(folder.path() / "first.exr");
        const Atlas b = readAtlas(again);
        for (int light = 0; light < 81; light += 7) {
            for (int view = 0; view < 81; view += 5) {
                CHECK(a.at({2, 1, light, view}) == b.at({2, 1, light, view}));
            }
        }
        fs::copy_file(again, folder.path() / "first.exr", fs::copy_options::overwrite_existing);
    }
}

TEST_CASE("atlas, UTIA file and atlas again are the same values on the UTIA grid") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    const fs::path atlas = folder.path() / "a.exr";
    converted(folder.path() / "btf", atlas, "utia288", AtlasKind::kAngular, "1x1");
    for (const char* format : {"utia-bin", "utia-exr"}) {
        const fs::path file = folder.path() / format;
        const auto report = exported(atlas, format, file);
        CHECK(report["extrapolated"]["values"] == 0);
        CHECK(report["source"] == "a.exr");
        converted(file, folder.path() / "back.exr", "input", AtlasKind::kAngular, "1x1");
        const Atlas a = readAtlas(atlas);
        const Atlas b = readAtlas(folder.path() / "back.exr");
        CHECK(a.header().grid == b.header().grid);
        for (int light = 0; light < 288; light += 11) {
            for (int view = 0; view < 288; view += 7) {
                CHECK(a.at({0, 0, light, view}) == b.at({0, 0, light, view}));
            }
        }
    }
}

TEST_CASE("the JSON beside the file is the report, and counts what lies past 75 degrees") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    const fs::path file = folder.path() / "m.binary";
    // All turns of this material are alike: two say what twelve do, in less time.
    const auto report = exported(folder.path() / "btf", "merl", file, {}, 2);
    CHECK(nlohmann::ordered_json::parse(bytesOf(file.string() + ".json")) == report);
    CHECK(report["max_measured_theta"].get<double>() == doctest::Approx(75));
    CHECK(report["extrapolated"]["grazing"] == "hold");
    CHECK(report["extrapolated"]["values"].get<int>() > 0);
    CHECK(report["texels_averaged"] == nlohmann::ordered_json({3, 2}));
    CHECK(report["lost"]["share_of_energy"].get<double>() < 0.001);
    // What was written is the mean over the texels.
    converted(file, folder.path() / "m.exr", "ubo81", AtlasKind::kAngular, "1x1");
    const Atlas atlas = readAtlas(folder.path() / "m.exr");
    const AngularGrid& grid = atlas.header().grid;
    for (std::size_t i = 0; i < grid.pairCount(); i += 13) {
        const Rgb c =
            atlas.at({0, 0, static_cast<int>(grid.lightOf(i)), static_cast<int>(grid.viewOf(i))});
        CHECK(c.r == doctest::Approx(material(grid.pair(i))).epsilon(0.02));
        CHECK(c.g == doctest::Approx(c.r / 2).epsilon(1e-5));
    }
}

TEST_CASE("one texel of a map is exported instead of the mean, from a stack and from an atlas") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    converted(folder.path() / "btf", folder.path() / "map.exr", "input", AtlasKind::kSpatial,
              "full");
    const fs::path file = folder.path() / "m.bin";
    for (const char* input : {"btf", "map.exr"}) {
        const auto report = exported(folder.path() / input, "utia-bin", file, TexelPlace{2, 1});
        CHECK(report["texel"] == nlohmann::ordered_json({2, 1}));
        CHECK_FALSE(report.contains("texels_averaged"));
        const auto reader = openBtf(file);
        const LightAndView pair = {{0, 0}, {radiansFromDegrees(30), 0}};
        // 0.75 + 0.25 x times 0.5 + y.
        CHECK(reader->table()->evaluate(pair).r ==
              doctest::Approx(1.25 * 1.5 * material(pair)).epsilon(1e-3));
        CHECK_THROWS_AS(exported(folder.path() / input, "utia-bin", file, TexelPlace{2, 2}),
                        std::runtime_error);
    }
    CHECK(texelPlaceFromName("12,40").y == 40);
    for (const char* name : {"", "3", "1,", "-1,2", "1,2,3", "a,b", "1;2"}) {
        CHECK_THROWS_AS(texelPlaceFromName(name), std::invalid_argument);
    }
}

TEST_CASE("an atlas without enough directions is refused, with what to do") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    std::ofstream(folder.path() / "few.csv") << "0,0\n30,0\n30,120\n30,240\n";
    converted(folder.path() / "btf", folder.path() / "few.exr",
              (folder.path() / "few.csv").string(), AtlasKind::kAngular, "1x1");
    try {
        exported(folder.path() / "few.exr", "rgl", folder.path() / "x.bsdf");
        FAIL("it passed");
    } catch (const std::runtime_error& error) {
        CHECK(std::string(error.what()).find("4 lights by 4 views are too few") !=
              std::string::npos);
    }
    CHECK_FALSE(fs::exists(folder.path() / "x.bsdf"));
}

TEST_CASE("directions are enough where they differ, in elevation and out of one plane") {
    const TemporaryFolder folder;
    std::vector<Direction> ring;
    std::vector<Direction> line;
    for (int k = 0; k < 20; ++k) {
        ring.push_back({1, 0.3 * k});
        line.push_back({0.07 * k, k % 2 * kPi});
    }
    const std::vector<std::pair<const char*, AngularGrid>> grids = {
        {"the normal often", AngularGrid(std::vector<Direction>(12, {0, 1}))},
        {"one ring", AngularGrid(ring)},
        {"one plane", AngularGrid(line)}};
    for (const auto& one : grids) {
        CAPTURE(one.first);
        writeAtlas(folder.path() / "a.exr",
                   syntheticAtlas(one.second, 1, 1, [](const LightAndView& p, int, int) {
                       const auto v = static_cast<float>(material(p));
                       return Rgb{v, v, v};
                   }));
        const std::string fault =
            faultOf([&] { exported(folder.path() / "a.exr", "rgl", folder.path() / "x.bsdf"); });
        CHECK(contains(fault, "are too few for a material"));
    }
}

TEST_CASE("values that are no light are left out of an export and counted; too many are refused") {
    const TemporaryFolder folder;
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const auto writeWith = [&](Rgb bad, int every) {
        int count = 0;
        writeAtlas(folder.path() / "a.exr", syntheticAtlas(AngularGrid(ubo81Directions()), 1, 1,
                                                           [&](const LightAndView& p, int, int) {
                                                               if (++count % every == 0) return bad;
                                                               const auto v =
                                                                   static_cast<float>(material(p));
                                                               return Rgb{v, v, v};
                                                           }));
    };
    for (const Rgb bad : {Rgb{kNaN, 1, 1}, Rgb{1, kInfinity, 1}, Rgb{1, 1, -0.5F}}) {
        writeWith(bad, 1000);
        const auto report = exported(folder.path() / "a.exr", "astm", folder.path() / "x");
        CHECK(report["left_out"] == 6);
        CHECK(contains(report["notes"].dump(), "6 values were NaN, infinite or negative"));
        writeWith(bad, 1);
        fs::remove(folder.path() / "x");
        const std::string fault =
            faultOf([&] { exported(folder.path() / "a.exr", "astm", folder.path() / "x"); });
        CHECK(contains(fault, "a.exr: 6561 of 6561 pairs of directions hold no light"));
        CHECK_FALSE(fs::exists(folder.path() / "x"));
    }
    writeWith({1, 1, 1}, 10000);
    CHECK(exported(folder.path() / "a.exr", "astm", folder.path() / "x")["left_out"] == 0);
}

TEST_CASE("an ubo81 atlas comes back from an RGL file within 1 %") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    converted(folder.path() / "btf", folder.path() / "a.exr", "input", AtlasKind::kAngular, "1x1");
    exported(folder.path() / "a.exr", "rgl", folder.path() / "a.bsdf");
    const auto reader = openBtf(folder.path() / "a.bsdf");
    const AngularGrid grid(ubo81Directions());
    double difference = 0;
    double sum = 0;
    for (const LightAndView& pair : pairsOf(grid)) {
        const auto c = reader->table()->evaluate(pair);
        difference += std::abs(static_cast<double>(c.r) - material(pair));
        sum += material(pair);
    }
    CHECK(difference / sum < 0.01);
}

TEST_CASE("an export onto its own input, or into nothing, is refused") {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "m.mbsdf";
    std::ofstream(file, std::ios::binary) << mbsdfBytes(4, 6);
    CHECK_THROWS_AS(exported(file, "utia-bin", file), std::runtime_error);
    CHECK_THROWS_AS(exported(file, "utia-bin", folder.path() / "none/x.bin"), std::runtime_error);
    CHECK_THROWS_AS(exported(file, "png", folder.path() / "x.png"), std::invalid_argument);
    CHECK(bytesOf(file) == mbsdfBytes(4, 6));
    // The JSON beside is a file as well: no input, and no folder.
    fs::rename(file, folder.path() / "m.json");
    CHECK(
        contains(faultOf([&] { exported(folder.path() / "m.json", "astm", folder.path() / "m"); }),
                 "m.json: is the input as well"));
    std::ofstream(folder.path() / "old") << "old";
    fs::create_directory(folder.path() / "old.json");
    CHECK_THROWS_AS(exported(folder.path() / "m.json", "astm", folder.path() / "old"),
                    std::runtime_error);
    CHECK(bytesOf(folder.path() / "old") == "old");
}

TEST_CASE("past the measured elevations a job holds, fades or goes on, and counts") {
    const TemporaryFolder folder;
    writeStack(folder.path() / "btf");
    std::ofstream(folder.path() / "grid.csv") << "0,0\n75,30\n85,30\n";
    const auto valueAt = [&](Grazing grazing) {
        ConvertOptions options;
        options.input.input = folder.path() / "btf";
        options.output = folder.path() / "a.exr";
        options.method.name = "measured";
        options.grid = (folder.path() / "grid.csv").string();
        options.grazing = grazing;
        options.pixel = PixelChoice::kFloat;
        const auto report = convert(options, {});
        CHECK(report["counts"]["extrapolated"] == 5);
        CHECK(report["grazing"] == nameOf(grazing));
        const Atlas atlas = readAtlas(options.output);
        CHECK(atlas.at({0, 0, 1, 0}).r > 0);
        return static_cast<double>(atlas.at({0, 0, 2, 0}).r / atlas.at({0, 0, 1, 0}).r);
    };
    const double cosines = std::cos(radiansFromDegrees(85)) / std::cos(radiansFromDegrees(75));
    CHECK(valueAt(Grazing::kHold) == doctest::Approx(cosines));
    CHECK(valueAt(Grazing::kFade) < 0.6 * cosines);
    CHECK(valueAt(Grazing::kExtrapolate) == doctest::Approx(cosines).epsilon(0.02));
}

TEST_SUITE_END();
