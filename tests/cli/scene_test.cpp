// SPDX-License-Identifier: BSD-3-Clause
#include "color/delta_e.h"
#include "tests/support/files_in.h"
#include "tests/support/rgl_samples.h"
#include "tests/support/run_program.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tensor_tree_file.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A map of 2 x 2 texels of different colours, glossy, brighter for viewers on the right.
fs::path glossyMap(const fs::path& folder, int width = 2) {
    const auto value = [](const LightAndView& p, int x, int y) {
        const Rgb c = lambertianWithGloss(
            p, {0.2F + 0.3F * static_cast<float>(x % 3), 0.3F, 0.1F + 0.4F * static_cast<float>(y)},
            0.3, 0.3);
        const double side = 1 + 0.3 * std::sin(p.view.theta) * std::cos(p.view.phi);
        return static_cast<float>(side) * c;
    };
    writeAtlas(folder / "map.exr", syntheticAtlas(AngularGrid(ubo81Directions()), width, 2, value));
    return folder / "map.exr";
}

/// R, G, B, A of part 0.
std::vector<float> rgbaOf(const fs::path& file, int& width) {
    const auto input = OIIO::ImageInput::open(file.string());
    REQUIRE(input);
    const OIIO::ImageSpec& spec = input->spec();
    width = spec.width;
    std::vector<float> all(static_cast<std::size_t>(spec.width) *
                           static_cast<std::size_t>(spec.height) * 4);
    REQUIRE(spec.nchannels >= 4);
    REQUIRE(input->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, all.data()));
    return all;
}

}  // namespace

TEST_SUITE_BEGIN("cli");

TEST_CASE("export --scene makes a folder for each renderer, and says how it is rendered") {
    const TemporaryFolder folder;
    glossyMap(folder.path());
    for (const std::string program : {"mitsuba", "pbrt", "radiance", "blender"}) {
        CAPTURE(program);
        const ProgramRun run = runProgram(
            folder.path(), fmt::format("export map.exr --scene {0} --light 20,50 -o {0}", program));
        CHECK(run.status == 0);
        CHECK(run.out.find("render it there with") != std::string::npos);
    }
    const RglSamples mitsuba(folder.path() / "mitsuba/material.bsdf");
    CHECK(mitsuba.fields().count("spectra") == 1);
    const std::string xml = bytesOf(folder.path() / "mitsuba/scene.xml");
    CHECK(xml.find("type=\"measured\"") != std::string::npos);
    CHECK(xml.find("z=\"-0.766044\"") != std::string::npos);
    const std::string pbrt = bytesOf(folder.path() / "pbrt/scene.pbrt");
    CHECK(pbrt.find("-0.604023 0.766044") != std::string::npos);
    CHECK(pbrt.starts_with("Scale -1 1 1"));  // Else it shows the mirror image.
    CHECK(TensorTreeFile(folder.path() / "radiance/material.xml").rank() == 4);
    CHECK(bytesOf(folder.path() / "radiance/scene.rad").find("6 0 material.xml 0 0 1 .") !=
          std::string::npos);
    for (const char* file : {"spatial.exr", "view_indices.exr", "view_shares.exr", "scene.py"}) {
        CHECK(fs::exists(folder.path() / "blender" / file));
    }
}

TEST_CASE("a scene replaces neither its input nor, where it fails, any file") {
    const TemporaryFolder folder;
    const auto run = [&](const std::string& call) { return runProgram(folder.path(), call); };
    fs::create_directory(folder.path() / "own");
    fs::rename(glossyMap(folder.path()), folder.path() / "own/spatial.exr");
    const std::string map = bytesOf(folder.path() / "own/spatial.exr");
    const ProgramRun own = run("export own/spatial.exr --scene blender -o own");
    CHECK(own.status == 1);
    CHECK(own.err.find("is the input as well") != std::string::npos);
    CHECK(bytesOf(folder.path() / "own/spatial.exr") == map);
    CHECK(filesIn(folder.path() / "own").size() == 1);
    // A folder stands where one of the files is to be.
    fs::create_directories(folder.path() / "old/scene.xml");
    std::ofstream(folder.path() / "old/material.bsdf") << "old";
    CHECK(run("export own/spatial.exr --scene mitsuba -o old").status == 1);
    CHECK(bytesOf(folder.path() / "old/material.bsdf") == "old");
    CHECK(filesIn(folder.path() / "old").size() == 2);
    const ProgramRun table = run("export own --scene blender -o new");
    CHECK(table.status == 1);
    CHECK(table.err.find("is no atlas") != std::string::npos);
    CHECK_FALSE(fs::exists(folder.path() / "new"));
    CHECK(run("export own/spatial.exr --scene blender -o ''").status == 1);
}

TEST_CASE("a report takes the place of no other file of its command") {
    const TemporaryFolder folder;
    const std::string map = bytesOf(glossyMap(folder.path()));
    for (const char* call : {"export map.exr --to astm -o x --report map.exr",
                             "export map.exr --to astm -o x --report ./x",
                             "--report=x export map.exr --to astm --output=x"}) {
        CAPTURE(call);
        const ProgramRun run = runProgram(folder.path(), call);
        CHECK(run.status == 2);
        CHECK(run.err.find("is a file of this command already") != std::string::npos);
        CHECK(bytesOf(folder.path() / "map.exr") == map);
        CHECK_FALSE(fs::exists(folder.path() / "x"));
    }
    CHECK(runProgram(folder.path(), "export map.exr --to astm -o x --report y").status == 0);
    CHECK(fs::exists(folder.path() / "y"));
}

TEST_CASE("a scene of an unknown renderer, or one beside a format, is refused") {
    const TemporaryFolder folder;
    glossyMap(folder.path());
    CHECK(runProgram(folder.path(), "export map.exr --scene povray -o x").status == 2);
    CHECK(runProgram(folder.path(), "export map.exr --scene pbrt --to rgl -o x").status == 2);
    CHECK(runProgram(folder.path(), "export map.exr -o x").status == 2);
    CHECK(runProgram(folder.path(), "export map.exr --to rgl --light 1,2 -o x").status == 2);
    const ProgramRun texel = runProgram(folder.path(), "export map.exr --to rgl --texel 2,0 -o x");
    CHECK(texel.status == 1);
    CHECK(texel.err.find("2 x 2 texels") != std::string::npos);
    CHECK_FALSE(fs::exists(folder.path() / "x"));
}

TEST_CASE("what an export cannot take is one sentence, and leaves nothing behind") {
    const TemporaryFolder folder;
    glossyMap(folder.path());
    REQUIRE(runProgram(folder.path(),
                       "convert map.exr -o few.exr --method measured --grid regular:2x4 -q")
                .status == 0);
    const auto before = filesIn(folder.path());
    struct Wrong {
        const char* call;
        int status;
        const char* says;
    };
    for (const Wrong& wrong : {
             Wrong{"few.exr --to rgl -o x", 1, "8 lights by 8 views are too few"},
             {"few.exr --to ssdd -o x", 1, "too few"},
             {"few.exr --scene pbrt -o x", 1, "too few"},
             {"map.exr --to rgl --cull 50 -o x", 2, "--cull: is not for rgl: it is for radiance"},
             {"map.exr --to merl --spectra -o x", 2, "is not for merl"},
             {"map.exr --to merl --resolution 64 -o x", 2, "is not for merl"},
             {"map.exr --to rgl --utia-encoding srgb -o x", 2, "is not for rgl"},
             {"map.exr --scene pbrt --cull 10 -o x", 2, "is not for pbrt"},
             {"map.exr --scene blender --texel 0,0 -o x", 2, "is not for blender"},
             {"map.exr --scene blender --light 0,95 -o x", 2, "is no light"},
             {"map.exr --scene blender --light 0,-5 -o x", 2, "is no light"},
             {"map.exr --scene blender --light 0,45,3 -o x", 2, "is no light"},
             {"map.exr --scene blender --light nan,45 -o x", 2, "is no light"},
             {"map.exr --to rgl --tolerance nan -o x", 2, "--tolerance"},
             {"map.exr --to rgl --tolerance -1 -o x", 2, "in range 0 to 100"},
             {"map.exr --to radiance --cull nan -o x", 2, "--cull"},
             {"map.exr --to radiance --resolution 24 -o x", 2, "8, 16, 32 cells a side, not 24"},
             {"map.exr --to rgl --texel 1.5,0 -o x", 2, "is no texel"},
             {"map.exr --to rgl -o absent/x", 1, "does not exist"},
             {"map.exr --to rgl --grazing mirror -o x", 2, "hold, fade"},
         }) {
        CAPTURE(wrong.call);
        const ProgramRun run = runProgram(folder.path(), std::string("export ") + wrong.call);
        CHECK(run.status == wrong.status);
        CHECK(run.err.find(wrong.says) != std::string::npos);
        CHECK(filesIn(folder.path()) == before);
    }
}

TEST_CASE("Blender shows the atlas as the preview does") {
    if (std::system("blender --version >/dev/null 2>&1") != 0) {
        MESSAGE("skipped: blender is absent");
        return;
    }
    const TemporaryFolder folder;
    glossyMap(folder.path(), 3);  // Wider than high: texels stay square.
    const ProgramRun run =
        runProgram(folder.path(), "export map.exr --scene blender --light -30,45 -o scene --json");
    REQUIRE(run.status == 0);
    const auto report = nlohmann::json::parse(run.out);
    const std::string blender =
        fmt::format("cd '{}/scene' && {} >blender.log 2>&1", folder.path().string(),
                    report["run"].get<std::string>());
    REQUIRE(std::system(blender.c_str()) == 0);
    const std::string preview = report["preview"];
    REQUIRE(runProgram(folder.path(), preview.substr(preview.find(' ') + 1) + " --background 0")
                .status == 0);
    int width = 0;
    int widthOfPreview = 0;
    const std::vector<float> a = rgbaOf(folder.path() / "scene/picture.exr", width);
    const std::vector<float> b = rgbaOf(folder.path() / "same.exr", widthOfPreview);
    REQUIRE(width == widthOfPreview);
    REQUIRE(a.size() == b.size());
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4) {
        if (a[i + 3] < 1) continue;  // Where the plane covers the pixel.
        const Lab x = labFromLinearRec709({a[i], a[i + 1], a[i + 2]});
        const Lab y = labFromLinearRec709({b[i], b[i + 1], b[i + 2]});
        sum += deltaE76(x, y);
        ++count;
    }
    CHECK(count > 50000);
    MESSAGE("mean Delta E ", sum / count);
    CHECK(sum / count < 2);
}

TEST_SUITE_END();
