// SPDX-License-Identifier: BSD-3-Clause
//
// Every real and virtual file of ../shared/data, through inspect and convert.
#include "pipeline/convert/convert.h"
#include "pipeline/inspect/inspect.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

const fs::path kData = ABRDF_SHARED_DATA;

bool isAbsent(const char* folder) {
    if (fs::exists(kData / folder)) return false;
    MESSAGE("skipped: ../shared/data/" << std::string(folder) << " is absent");
    return true;
}

Atlas measured(const fs::path& input, const fs::path& output, const std::string& grid = "input") {
    ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "measured";
    options.grid = grid;
    options.pixel = PixelChoice::kFloat;
    convert(options, {});
    return readAtlas(output);
}

/// Relative errors of all values of a 1 x 1 atlas, ascending.
std::vector<double> errorsOf(const Atlas& atlas, const std::vector<Rgb>& truth) {
    std::vector<double> errors;
    const AngularGrid& grid = atlas.header().grid;
    REQUIRE(truth.size() == grid.pairCount());
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const Rgb c =
            atlas.at({0, 0, static_cast<int>(grid.lightOf(i)), static_cast<int>(grid.viewOf(i))});
        for (const auto channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
            errors.push_back(std::abs(static_cast<double>(c.*channel / truth[i].*channel) - 1));
        }
    }
    std::ranges::sort(errors);
    return errors;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the virtual twill's mean is its clipped truth, to the JPEGs' error") {
    if (isAbsent("virtual")) return;
    const TemporaryFolder folder;
    const Atlas atlas = measured(kData / "virtual/twill_ubo2003.zip", folder.path() / "t.exr");
    const auto errors = errorsOf(atlas, sharedTable("virtual/twill_clipped_mean_f32.bin"));
    CHECK(errors[errors.size() / 2] < 0.003);
    CHECK(errors.back() < 0.015);
}

TEST_CASE("the virtual twill's mean is resampled onto the UTIA grid to a percent") {
    if (isAbsent("virtual")) return;
    const TemporaryFolder folder;
    const Atlas atlas =
        measured(kData / "virtual/twill_ubo2003.zip", folder.path() / "t.exr", "utia288");
    const auto errors = errorsOf(atlas, sharedTable("virtual/twill_utia_mean_f32.bin"));
    CHECK(errors[errors.size() / 2] < 0.01);
    CHECK(errors[errors.size() * 9 / 10] < 0.03);
}

TEST_CASE("the means of the synthetic .btf files do not depend on the container's type") {
    if (isAbsent("ubo2014")) return;
    const TemporaryFolder folder;
    const Atlas dfmf = measured(kData / "ubo2014/woven_dfmf.btf", folder.path() / "a.exr");
    const Atlas fmf = measured(kData / "ubo2014/woven_fmf.btf", folder.path() / "b.exr");
    CHECK(dfmf.header().layout.lights == 151);
    CHECK(dfmf.header().cosine == Cosine::kKept);
    double square = 0;
    for (int i = 0; i < 151; ++i) {
        const float a = dfmf.at({0, 0, i, 150 - i}).g;
        const float b = fmf.at({0, 0, i, 150 - i}).g;
        square += std::pow(static_cast<double>(a / b) - 1, 2);
    }
    CHECK(std::sqrt(square / 151) < 2e-3);
}

TEST_CASE("a measured material is sampled exactly where the atlas asks") {
    if (isAbsent("rgl")) return;
    const TemporaryFolder folder;
    const Atlas atlas =
        measured(kData / "rgl/paper_white_rgb.bsdf", folder.path() / "p.exr", "ubo81");
    const auto errors = errorsOf(atlas, sharedTable("measured81/rgl_paper_white_f32.bin"));
    CHECK(errors[errors.size() / 2] < 1e-5);
    CHECK(errors[errors.size() * 95 / 100] < 1e-4);
}

TEST_CASE("inspect tells of every file that it is whole, and how the cosine is known") {
    for (const char* name : {"ubo2003", "ubo2014/woven_bdi.btf", "mbsdf/carpaint_red.mbsdf",
                             "rgl/aurora_white_rgb.bsdf"}) {
        if (isAbsent(name)) continue;
        CAPTURE(std::string(name));
        const auto report = inspect(kData / name, {});
        CHECK(report["complete"] == true);
        CHECK(report["nonfinite"] == 0);
        CHECK(report["below_horizon"] == 0);
        CHECK(report["cosine"] == "kept");
        CHECK_FALSE(report["cosine_from"].get<std::string>().empty());
        if (report["reciprocity"]["pairs"] != 0) {
            CHECK(report["reciprocity"]["cosine_by_it"] == "kept");
            CHECK(report["reciprocity"]["largest"].get<double>() <= 2);
        }
    }
}

TEST_SUITE_END();
