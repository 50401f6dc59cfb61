// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/inspect.h"

#include "pipeline/convert/convert.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

SyntheticBtf smallBtf() {
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(2, 3), regularDirections(3, 2));
    btf.width = 3;
    btf.height = 2;
    btf.value = [](const LightAndView&, int x, int) {
        return Rgb{0.25F * static_cast<float>(x), 1.5F, 0.5F};
    };
    return btf;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a whole database is complete, and its report says what it is") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", smallBtf());
    const auto report = inspect(folder.path() / "btf", {});
    CHECK(report["format"] == "UBO2003");
    CHECK(report["lights"] == 6);
    CHECK(report["views"] == 6);
    CHECK(report["images"] == 36);
    CHECK(report["width"] == 3);
    CHECK(report["height"] == 2);
    CHECK(report["complete"] == true);
    CHECK(report["cosine"] == "kept");
    CHECK(report["color_space"] == "Linear Rec.709 (sRGB)");
    CHECK(report["stored_range"][0] == 0.0);
    CHECK(report["stored_range"][1] == 1.5);
    CHECK(report["max_theta"].get<double>() == doctest::Approx(75));
    for (const char* key : {"missing", "duplicate", "unreadable"}) CHECK(report[key].empty());
}

TEST_CASE("missing, double, unreadable and unreal are each told, by name") {
    const TemporaryFolder folder;
    SyntheticBtf btf = smallBtf();
    btf.value = [](const LightAndView& p, int x, int) {
        const bool bad = x == 0 && p.light.theta > 1 && p.view.theta > 1;
        const float v = bad ? std::nanf("") : 0.5F;
        return Rgb{v, 0.5F, 0.5F};
    };
    const fs::path path = folder.path() / "btf";
    writeSyntheticBtf(path, btf);
    // Light 5: theta 75, phi 240; view 5: theta 75, phi 180. Light 1, view 2.
    fs::remove(path / syntheticFile(btf, 35));
    fs::copy_file(path / syntheticFile(btf, 8),
                  path / ("copy of " + syntheticFile(btf, 8).filename().string()));
    const fs::path damaged = path / syntheticFile(btf, 20);
    fs::resize_file(damaged, fs::file_size(damaged) / 2);
    const auto report = inspect(path, {});
    CHECK(report["complete"] == false);
    REQUIRE(report["missing"].size() == 1);
    CHECK(report["missing"][0] == "tl075 pl240 tv075 pv180");
    REQUIRE(report["duplicate"].size() == 1);
    CHECK(report["duplicate"][0].get<std::string>().find("copy of") != std::string::npos);
    REQUIRE(report["unreadable"].size() == 1);
    CHECK(report["unreadable"][0].get<std::string>().find(damaged.filename().string()) !=
          std::string::npos);
    CHECK(report["nonfinite"].get<int>() > 0);
    const std::string text = textOf(report);
    CHECK(text.find("tl075 pl240 tv075 pv180") != std::string::npos);
    CHECK(text.find("complete") != std::string::npos);
}

TEST_CASE("an atlas is told from its header alone, and a cut one is not complete") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", smallBtf());
    ConvertOptions options;
    options.input.input = folder.path() / "btf";
    options.output = folder.path() / "a.exr";
    options.method.name = "measured";
    options.texels = {3, 2};
    options.layout = AtlasKind::kSpatial;
    convert(options, {});
    auto report = inspect(options.output, {});
    CHECK(report["lights"] == 6);
    CHECK(report["width"] == 18);
    CHECK(report["height"] == 12);
    CHECK(report["layout"] == "spatial");
    CHECK(report["method"] == "measured");
    CHECK(report["source"] == "btf");
    CHECK(report["color_interop_id"] == "lin_rec709_scene");
    CHECK(report["complete"] == true);
    fs::resize_file(options.output, fs::file_size(options.output) - 10);
    report = inspect(options.output, {});
    CHECK(report["complete"] == false);
    CHECK(report["unreadable"].size() == 1);
}

TEST_CASE("what is neither database nor atlas is refused by its path") {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "notes.txt") << "tl0 pl0 tv0 pv0";
    for (const fs::path& path :
         {folder.path(), folder.path() / "notes.txt", folder.path() / "absent"}) {
        CAPTURE(path.string());
        try {
            inspect(path, {});
            FAIL("it passed");
        } catch (const std::runtime_error& error) {
            CHECK(std::string(error.what()).find(path.string()) != std::string::npos);
        }
    }
}

TEST_SUITE_END();
