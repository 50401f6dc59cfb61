// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/report/report.h"

#include "pipeline/report/report_files.h"
#include "tests/support/fault_of.h"
#include "tests/support/synthetic_atlas.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

void writeMaterial(const fs::path& file, const std::string& source, const std::string& method,
                   float grey) {
    const Atlas made =
        syntheticAtlas(AngularGrid(ubo81Directions()), 1, 1, [&](const LightAndView& p, int, int) {
            return lambertianWithGloss(p, {grey, grey, grey}, 1, 0.3);
        });
    AtlasHeader header = made.header();
    header.source = source;
    header.method = method;
    writeAtlas(file, Atlas(header, made.pixels()));
}

void writeText(const fs::path& file, const std::string& text) {
    std::ofstream(file) << text;
}

PageOptions optionsFor(const fs::path& output) {
    PageOptions options;
    options.output = output;
    options.colorConfig = fs::path(ABRDF_SOURCE_DIR) / "color/config.ocio";
    return options;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("five materials with their measurements make a page well below 5 MB, found by source") {
    const TemporaryFolder folder;
    for (int i = 0; i < 5; ++i) {
        const std::string source = "m" + std::to_string(i) + ".zip";
        writeMaterial(folder.path() / (source + "_a.exr"), source, "measured", 0.5F);
        writeMaterial(folder.path() / (source + "_b.exr"), source, "published", 0.45F);
    }
    writeMaterial(folder.path() / "alone.exr", "alone.zip", "measured", 0.5F);
    writeText(folder.path() / "notes.txt", "no part of it");
    const auto report = reportFolder(folder.path(), optionsFor(folder.path() / "page.html"), {});
    CHECK(report["command"] == "report");
    CHECK(report["materials"] == 6);
    const std::string html = bytesOf(folder.path() / "page.html");
    CHECK(report["output"]["bytes"] == html.size());
    CHECK(html.size() < 2'500'000);
    CHECK(contains(html, "published, plan all, 0 samples, mean ΔE "));
    CHECK(contains(html, "alone.zip"));
    CHECK(contains(html, "Un-tone-mapped") == false);
}

TEST_CASE("reports of each command come into their places, others are named and left out") {
    const TemporaryFolder folder;
    const auto file = [&](const char* name, const std::string& text) {
        writeText(folder.path() / name, text);
        return folder.path() / name;
    };
    PageContent content;
    const auto others =
        addReports({file("a.json", R"({"command": "evaluate", "input": "x.zip", "results": [
             {"method": "published", "plan": "poster", "samples": 204, "images_read": 336,
              "delta_e": 2.5, "delta_e_2000": 2, "rmse": 7, "psnr": 30, "stops": 0.1,
              "highlight": {"delta_e": 3, "psnr": 26}, "microseconds_per_abrdf": 33}]})"),
                    file("b.json", R"({"command": "chart", "results": [
             {"method": "prior", "input": "x.zip", "samples": 52, "delta_e": 1,
              "microseconds_per_abrdf": 90}, {"method": "slow", "delta_e": 1}]})"),
                    file("c.json", R"({"command": "stress", "results": [
             {"case": "noise", "method": "prior", "breakdown": 0.1},
             {"case": "noise", "method": "published", "breakdown": "at once"},
             {"case": "clipping", "method": "published", "breakdown": 2}]})"),
                    file("d.json", R"({"command": "convert", "method": "prior", "texels": [1, 1],
             "output": {"path": "a.exr"}})"),
                    file("e.json", R"({"command": "plan"})"), file("f.json", "[]")},
                   content);
    CHECK(others == std::vector<std::string>{"e.json", "f.json"});
    REQUIRE(content.tables.size() == 2);
    CHECK(content.tables[0].rows.size() == 1);
    CHECK(content.tables[0].rows[0].size() == content.tables[0].columns.size());
    CHECK(content.tables[1].rows[0].size() == content.tables[1].columns.size());
    CHECK(content.tables[1].rows[0][5] == "1 x 1");
    REQUIRE(content.points.size() == 2);
    CHECK(content.points[1].method == "prior");
    REQUIRE(content.matrices.size() == 1);
    const PageDataTable& matrix = content.matrices[0];
    CHECK(matrix.columns == std::vector<std::string>{"Case", "prior", "published"});
    CHECK(matrix.rows[0][2] == "at once");
    CHECK(matrix.rows[1][1].is_null());
    CHECK(matrix.rows[1][2] == 2);
}

TEST_CASE("a damaged report, a folder without anything and a display that is not sRGB are named") {
    const TemporaryFolder folder;
    const PageOptions options = optionsFor(folder.path() / "page.html");
    const auto ask = [&](const PageOptions& o) {
        return faultOf<std::exception>([&] { reportFolder(folder.path(), o, {}); });
    };
    CHECK(contains(ask(options), "neither an atlas"));
    CHECK(
        contains(faultOf<std::exception>([&] { reportFolder(folder.path() / "no", options, {}); }),
                 "is no folder"));
    writeText(folder.path() / "a.json", "{");
    CHECK(contains(ask(options), "a.json: is no JSON"));
    writeText(folder.path() / "a.json", R"({"command": "evaluate"})");
    CHECK(contains(ask(options), "a.json: is no whole report of abrdf evaluate"));
    writeText(folder.path() / "a.json", R"({"command": "evaluate", "input": "x", "results": []})");
    PageOptions video = options;
    video.display.display = "Rec.1886 Rec.709 - Display";
    CHECK(contains(ask(video), "sRGB"));
    CHECK_FALSE(fs::exists(options.output));
    CHECK(ask(options).empty());
    CHECK(fs::exists(options.output));
}

TEST_SUITE_END();
