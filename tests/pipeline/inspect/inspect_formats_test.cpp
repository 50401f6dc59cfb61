// SPDX-License-Identifier: BSD-3-Clause
//
// What inspect says beyond the list of files, and colours that are not RGB.
#include "pipeline/convert/convert.h"
#include "pipeline/inspect/inspect.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// One view of one light, two pixels.
void writeXyz(const fs::path& folder, const std::vector<float>& pixels) {
    const fs::path file = folder / "tv000_pv000" / "tl000_pl000_tv000_pv000.exr";
    fs::create_directories(file.parent_path());
    const OIIO::ImageSpec spec(2, 1, 3, OIIO::TypeDesc::FLOAT);
    const auto output = OIIO::ImageOutput::create(file.string());
    REQUIRE(output->open(file.string(), spec));
    output->write_image(OIIO::TypeDesc::FLOAT, pixels.data());
    output->close();
}

Rgb meanOf(const fs::path& input, const fs::path& output) {
    ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "measured";
    options.pixel = PixelChoice::kFloat;
    CHECK(convert(options, {})["counts"]["nonfinite"] == 0);
    return readAtlas(output).at({});
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("inspect measures reciprocity and counts what lies below the horizon") {
    const TemporaryFolder folder;
    SyntheticBtf btf;
    std::vector<Direction> directions = regularDirections(3, 4);
    directions.erase(directions.begin(), directions.begin() + 3);  // One pole is enough.
    btf.grid = AngularGrid(directions);
    btf.value = [&](const LightAndView& p, int, int) {
        // Reciprocal but for one pair.
        const bool odd = p.light == directions[2] && p.view == directions[3];
        const auto v = static_cast<float>(std::cos(p.light.theta) * (odd ? 2 : 1));
        return Rgb{v, v, v};
    };
    writeSyntheticBtf(folder.path(), btf);
    fs::copy_file(folder.path() / syntheticFile(btf, 0), folder.path() / "tl100 pl0 tv0 pv0.exr");
    const auto report = inspect(folder.path(), {});
    CHECK(report["complete"] == true);
    CHECK(report["below_horizon"] == 1);
    CHECK(report["reciprocity"]["pairs"] == 36);
    CHECK(report["reciprocity"]["largest"].get<double>() == doctest::Approx(2.0 / 3));
    CHECK(report["reciprocity"]["where"].get<std::string>() == "tl37.5 pl090 tv37.5 pv180");
    CHECK(report["reciprocity"]["cosine_by_it"] == "kept");
    CHECK(report["max_measured_theta"].get<double>() == doctest::Approx(75));
    const std::string text = textOf(report);
    CHECK(text.find("cosine_from         convention") != std::string::npos);
}

TEST_CASE("CIE XYZ becomes RGB through OpenColorIO, and colours outside of it count") {
    const TemporaryFolder folder;
    // The white of D65, twice.
    writeXyz(folder.path() / "white", {0.95046F, 1, 1.08906F, 0.95046F, 1, 1.08906F});
    const Rgb white = meanOf(folder.path() / "white", folder.path() / "a.exr");
    for (const float c : {white.r, white.g, white.b}) CHECK(c == doctest::Approx(1).epsilon(1e-3));
    // A saturated green and a red, whose mean is inside though the green is not.
    writeXyz(folder.path() / "mixed", {0.1F, 0.4F, 0.05F, 0.6F, 0.3F, 0.05F});
    const Rgb mixed = meanOf(folder.path() / "mixed", folder.path() / "b.exr");
    const double x = 0.35;
    const double y = 0.35;
    const double z = 0.05;
    CHECK(mixed.r == doctest::Approx(3.2406 * x - 1.5372 * y - 0.4986 * z).epsilon(1e-3));
    CHECK(mixed.g == doctest::Approx(-0.9689 * x + 1.8758 * y + 0.0415 * z).epsilon(1e-3));
}

TEST_SUITE_END();
