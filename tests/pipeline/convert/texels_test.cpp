// SPDX-License-Identifier: BSD-3-Clause
//
// Maps of single texels: the plane of the surface in convert and evaluate.
#include "abrdf/atlas.h"
#include "abrdf/for_each_texel.h"
#include "pipeline/convert/convert.h"
#include "pipeline/demo/demo_database.h"
#include "pipeline/evaluate/evaluate.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

constexpr int kSize = 24;

/// A texture one texel above the plane of rectification, exactly: its images are moved by whole
/// texels at 45 degrees.
SyntheticBtf raised(int height) {
    SyntheticBtf btf;
    btf.grid = AngularGrid([] {
        std::vector<Direction> directions = {{0, 0}};
        for (int k = 0; k < 8; ++k) directions.push_back({kPi / 4, k * kPi / 4});
        return directions;
    }());
    btf.width = kSize;
    btf.height = kSize;
    btf.value = [height](const LightAndView& p, int x, int y) {
        const Shift shift = parallax(height, p.view);
        const double u = 2 * kPi * (x - shift.x) / kSize;
        const double v = 2 * kPi * (y - shift.y) / kSize;
        const double c = 0.4 + 0.15 * std::sin(2 * u) * std::cos(v) + 0.1 * std::sin(3 * v - u) +
                         0.1 * std::cos(p.light.theta);
        return Rgb{static_cast<float>(c), static_cast<float>(0.7 * c), static_cast<float>(0.4 * c)};
    };
    return btf;
}

ConvertOptions jobOn(const fs::path& input, const fs::path& output) {
    ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "published";
    options.method.plan.elevations = {20, 45};
    options.texels = {0, 0};
    options.pixel = PixelChoice::kFloat;
    return options;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("planes and edges are named; nonsense is refused") {
    CHECK(planeFromName("auto").search);
    CHECK_FALSE(planeFromName("off").search);
    CHECK(planeFromName("-2.5").height == -2.5);
    CHECK(edgesFromName("cropped") == Edges::kCropped);
    CHECK_FALSE(edgesFromName("auto").has_value());
    for (const char* name : {"", "on", "3x", "1e9", "nan"}) {
        CHECK_THROWS_AS(planeFromName(name), std::invalid_argument);
    }
    CHECK_THROWS_AS(edgesFromName("round"), std::invalid_argument);
}

TEST_CASE("a raised texture is found, and said in report and header") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", raised(2));
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "aligned.exr");
    const auto report = convert(options, {});
    CHECK(report["plane"]["height"].get<double>() == doctest::Approx(2).epsilon(0.05));
    CHECK(report["plane"]["edges"] == "periodic");
    CHECK(report["counts"]["outside"] == 0);
    const Atlas aligned = readAtlas(options.output);
    CHECK(aligned.header().plane == doctest::Approx(2).epsilon(0.05));
}

TEST_CASE("unshifted, images are those of the database, however they were shifted") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = raised(2);
    writeSyntheticBtf(folder.path() / "btf", btf);
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.method = {};
    options.method.name = "measured";
    options.plane = planeFromName("2");
    options.plane.unshift = true;
    convert(options, {});
    const Atlas atlas = readAtlas(options.output);
    CHECK(atlas.header().plane == 0);
    // Views along the axes are shifted by whole texels, which loses nothing.
    for (const std::size_t view : {0U, 1U, 3U, 5U, 7U}) {
        for (int y = 0; y < kSize; ++y) {
            const std::size_t pair = 2 * btf.grid.views().size() + view;
            const LightAndView directions = btf.grid.pair(pair);
            const float green = lookUp(atlas, directions.light, directions.view, 7, y).g;
            CHECK(green == doctest::Approx(btf.value(directions, 7, y).g).epsilon(1e-3));
        }
    }
}

TEST_CASE("texels whose place leaves a cropped image are counted") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", raised(2));
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.plane.search = false;
    options.plane.height = 2;
    options.plane.edges = Edges::kCropped;
    const auto report = convert(options, {});
    CHECK(report["counts"]["outside"].get<int>() > 0);
    CHECK(report["plane"]["margin"] == 2);
    CHECK(readAtlas(options.output).header().margin == 2);
    CHECK(readAtlas(options.output).header().counts.outside ==
          report["counts"]["outside"].get<std::uint64_t>());
}

TEST_CASE("the average of a material does not depend on a plane, and is not searched for one") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", raised(2));
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.texels = {1, 1};
    const auto report = convert(options, {});
    CHECK(report["plane"]["height"] == 0.0);
    CHECK_FALSE(report["plane"].contains("residual"));
}

TEST_CASE("evaluate compares in the frame of the result") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", raised(2));
    EvaluateOptions options;
    options.input.input = folder.path() / "btf";
    options.methods = {"published"};
    options.choice.plan.elevations = {20, 45};
    options.texels = {0, 0};
    const auto error = [&](const char* plane, bool unshift) {
        options.plane = planeFromName(plane);
        options.plane.unshift = unshift;
        return evaluate(options, {})["results"][0]["unsampled"]["texels"]["delta_e"].get<double>();
    };
    const double off = error("off", false);
    CHECK(error("2", false) < 0.5 * off);
    CHECK(error("2", true) < 0.5 * off);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("threads");

TEST_CASE("an aligned and an unshifted map have the same bytes on any number of threads") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", raised(2));
    for (const bool unshift : {false, true}) {
        std::string first;
        for (const int threads : {1, 2, 7}) {
            const ThreadLimit limit(threads);
            ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
            options.plane.unshift = unshift;
            convert(options, {});
            const std::string bytes = bytesOf(options.output);
            if (first.empty()) first = bytes;
            CHECK(bytes == first);
        }
    }
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("slow");

TEST_CASE("the demo's known height is found, and a flat cloth is left where it is") {
    const TemporaryFolder folder;
    struct Case {
        double relief;
        double height;
        double tolerance;
    };
    for (const Case& c : {Case{1, 3.3, 0.2}, Case{0, 3.3, 0.05}, Case{0, 0, 0}, Case{1, 0, 0}}) {
        // clang 14's lambdas, which CAPTURE makes, cannot take a binding.
        const double relief = c.relief;
        const double height = c.height;
        const double tolerance = c.tolerance;
        CAPTURE(relief);
        CAPTURE(height);
        const fs::path zip = folder.path() / "demo.zip";
        fs::remove(zip);
        DemoOptions demo;
        demo.relief = static_cast<float>(relief);
        demo.height = height;
        writeDemoDatabase(zip, demo, {});
        ConvertOptions options = jobOn(zip, folder.path() / "a.exr");
        options.method.plan = {};
        options.grid = "regular:1x1";
        const auto plane = convert(options, {})["plane"];
        CHECK(std::abs(plane["height"].get<double>() - height) <= tolerance);
        MESSAGE("relief " << relief << ", height " << height << ": " << plane.dump());
    }
}

TEST_CASE("single texels of the rendered twill come back with their figures") {
    const fs::path twill = fs::path(ABRDF_SHARED_DATA) / "virtual/twill_ubo2003.zip";
    if (!fs::exists(twill)) {
        MESSAGE("skipped: there is no rendered twill beside this checkout");
        return;
    }
    EvaluateOptions options;
    options.input.input = twill;
    options.methods = {"prior"};
    const auto measure = [&](const char* plan, Texels texels) {
        options.choice.plan.name = plan;
        options.texels = texels;
        const auto unsampled = evaluate(options, {})["results"][0]["unsampled"];
        MESSAGE(std::string(plan) << ", " << texels.width << " x " << texels.height
                                  << " texels: " << unsampled["delta_e"] << " / "
                                  << unsampled["psnr"] << ", " << unsampled["texels"].dump());
        return std::pair{unsampled["delta_e"].get<double>(), unsampled["psnr"].get<double>()};
    };
    const auto full = measure("greedy", {64, 64});
    CHECK(full.first <= 6.2);
    CHECK(full.second >= 23);
    const auto four = measure("greedy", {16, 16});
    CHECK(four.first <= 3.5);
    CHECK(four.second >= 27.5);
    const auto sixteen = measure("greedy", {4, 4});
    CHECK(sixteen.first <= 1.4);
    CHECK(sixteen.second >= 35);
    CHECK(measure("eight", {64, 64}).first <= 8);
}

TEST_SUITE_END();
