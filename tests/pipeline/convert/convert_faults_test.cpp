// SPDX-License-Identifier: BSD-3-Clause
//
// What a job does when something is wrong, and on data that nobody made for it.
#include "color/delta_e.h"
#include "pipeline/convert/convert.h"
#include "pipeline/convert/dry_run.h"
#include "stages/read/atlas_reader.h"
#include "tests/support/fault_of.h"
#include "tests/support/file_size_limit.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/write_zip.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

SyntheticBtf smallBtf() {
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(6, 6));
    btf.width = 3;
    btf.height = 2;
    btf.extension = "png";
    btf.value = [](const LightAndView& p, int x, int y) {
        const double c = 0.4 + 0.3 * std::sin(p.light.phi + 2 * p.view.phi) * std::cos(x + 2 * y);
        return Rgb{static_cast<float>(c), 0.5F, static_cast<float>(1 - c)};
    };
    return btf;
}

ConvertOptions jobOn(const fs::path& input, const fs::path& output) {
    ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "published";
    options.texels = {0, 0};
    return options;
}

/// What a job says; empty where it passes.
std::string faultOf(const ConvertOptions& options) {
    return abrdf::faultOf([&] { convert(options, {}); });
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a job that fails at an image names it, leaves the old atlas, and nothing else") {
    const TemporaryFolder folder;
    SyntheticBtf btf = smallBtf();
    btf.extension = "jpg";
    writeSyntheticBtf(folder.path() / "btf", btf);
    const fs::path out = folder.path() / "out";
    fs::create_directory(out);
    const ConvertOptions options = jobOn(folder.path() / "btf", out / "a.exr");
    const auto planned = planConvert(options)["images"].get<std::vector<std::string>>();
    const fs::path damaged = planned[planned.size() / 2];
    fs::resize_file(damaged, fs::file_size(damaged) / 2);
    std::ofstream(options.output) << "old";
    CHECK(faultOf(options).find(damaged.filename().string()) != std::string::npos);
    CHECK(bytesOf(options.output) == "old");
    CHECK(std::distance(fs::directory_iterator(out), {}) == 1);
}

TEST_CASE("a job that finds the disk full names the atlas and leaves the old one") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", smallBtf());
    const fs::path out = folder.path() / "out";
    fs::create_directory(out);
    ConvertOptions options = jobOn(folder.path() / "btf", out / "a.exr");
    options.compression = Compression::kNone;
    std::ofstream(options.output) << "old";
    std::string fault;
    {
        const FileSizeLimit limit(1024);
        fault = faultOf(options);
    }
    CHECK(fault.find("a.exr") != std::string::npos);
    CHECK(bytesOf(options.output) == "old");
    CHECK(std::distance(fs::directory_iterator(out), {}) == 1);
}

TEST_CASE("the input is never overwritten, and elevations that were not measured are refused") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = smallBtf();
    writeSyntheticBtf(folder.path() / "btf", btf);
    writeZip(folder.path() / "btf.zip", folder.path() / "btf", false);
    const std::string before = bytesOf(folder.path() / "btf.zip");
    CHECK_FALSE(faultOf(jobOn(folder.path() / "btf.zip", folder.path() / "btf.zip")).empty());
    CHECK(bytesOf(folder.path() / "btf.zip") == before);
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.method.plan.elevations = {30, 80};
    CHECK(faultOf(options).find("80") != std::string::npos);
    options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.texels = {4, 1};
    CHECK_THROWS_AS(convert(options, {}), std::invalid_argument);
    CHECK_FALSE(fs::exists(folder.path() / "a.exr"));
}

TEST_CASE("a zip gives the atlas of its folder") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "a" / "btf", smallBtf());
    writeZip(folder.path() / "btf", folder.path() / "a" / "btf", true);
    convert(jobOn(folder.path() / "a" / "btf", folder.path() / "1.exr"), {});
    convert(jobOn(folder.path() / "btf", folder.path() / "2.exr"), {});
    CHECK(bytesOf(folder.path() / "1.exr") == bytesOf(folder.path() / "2.exr"));
}

TEST_CASE("a bounded plan is kept to: at most N samples, and no image beyond those planned") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", smallBtf());
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.method.plan.name = "poster:100";
    const auto planned = planConvert(options);
    const auto report = convert(options, {});
    CHECK(report["plan"]["samples"].get<int>() <= 100);
    CHECK(report["plan"]["images_read"] == planned["images"].size());
    CHECK(report["plan"]["name"] == "poster:100");
    CHECK(report["output"]["bytes"] == fs::file_size(options.output));
    CHECK(report["output"]["pixel"] == "half");
    CHECK(readAtlasHeader(options.output).plan == "poster:100");
}

TEST_CASE("the real view of UBO2003 is averaged as its pixels say") {
    const fs::path real = fs::path(ABRDF_SHARED_DATA) / "ubo2003";
    if (!fs::exists(real)) {
        MESSAGE("skipped: ../shared/data/ubo2003 is absent");
        return;
    }
    const TemporaryFolder folder;
    ConvertOptions options = jobOn(real, folder.path() / "a.exr");
    options.texels = {1, 1};
    CHECK(faultOf(options).find("elevation") != std::string::npos);
    options.method.name = "measured";
    options.pixel = PixelChoice::kFloat;
    convert(options, {});
    const Atlas atlas = readAtlas(options.output);
    CHECK(atlas.header().layout.height() == 81);
    CHECK(atlas.header().layout.width() == 1);
    const auto reader = openBtf(real);
    for (const std::size_t light : {std::size_t{0}, std::size_t{33}, std::size_t{80}}) {
        const EncodedImage image = reader->read(light);
        const auto& codes = std::get<std::vector<std::uint8_t>>(image.rgb);
        double sum = 0;
        for (std::size_t i = 1; i < codes.size(); i += 3) sum += linearFromSrgb(codes[i] / 255.0);
        const double mean = 3 * sum / static_cast<double>(codes.size());
        CHECK(static_cast<double>(atlas.at({0, 0, static_cast<int>(light), 0}).g) ==
              doctest::Approx(mean).epsilon(1e-4));
    }
}

TEST_SUITE_END();
