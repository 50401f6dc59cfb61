// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/evaluate/evaluate.h"

#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

SyntheticBtf smallBtf() {
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(6, 6));
    btf.width = 2;
    btf.value = [](const LightAndView& p, int x, int) {
        const double c = 0.4 + 0.1 * x +
                         0.2 * std::cos(p.light.phi + p.view.phi) * std::sin(p.light.theta) *
                             std::sin(p.view.theta);
        return Rgb{static_cast<float>(c), static_cast<float>(c / 2), 0.1F};
    };
    return btf;
}

EvaluateOptions optionsFor(const fs::path& input) {
    EvaluateOptions options;
    options.input.input = input;
    return options;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("the report has every key of the interface, and the table a row a method") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", smallBtf());
    EvaluateOptions options = optionsFor(folder.path() / "btf");
    options.methods = {"published", "measured"};
    options.texels = {2, 1};
    std::atomic<std::size_t> ticks = 0;
    const auto report = evaluate(options, [&](const ProgressTick&) { ++ticks; });
    CHECK(ticks >= 1296);
    CHECK(report["pairs"] == 1296);
    REQUIRE(report["results"].size() == 2);
    for (const auto& result : report["results"]) {
        for (const char* key :
             {"method", "plan", "samples", "images_read", "delta_e", "delta_e_2000", "rmse", "psnr",
              "stops", "highlight", "unsampled", "microseconds_per_abrdf", "multiply_adds"}) {
            CAPTURE(key);
            CHECK(result.contains(key));
        }
        for (const char* key : {"delta_e", "delta_e_2000", "rmse", "psnr"}) {
            CHECK(result["highlight"].contains(key));
            CHECK(result["unsampled"].contains(key));
        }
        for (const char* key :
             {"delta_e", "delta_e_95", "psnr", "psnr_95", "s_cielab", "ssim", "images_seen"}) {
            CAPTURE(key);
            CHECK(result["texels"].contains(key));
            CHECK(result["unsampled"]["texels"].contains(key));
        }
    }
    const auto& published = report["results"][0];
    CHECK(published["samples"] == 204);
    CHECK(published["delta_e"].get<double>() > 0);
    // Both texels.
    CHECK(published["pairs"] == 2 * 1296);
    CHECK(published["unsampled"]["pairs"] ==
          2 * (1296 - published["images_read"].get<std::size_t>()));
    const auto& measured = report["results"][1];
    CHECK(measured["images_read"] == 1296);
    CHECK(measured["rmse"] == 0.0);
    CHECK(measured["unsampled"]["pairs"] == 0);
    const std::string table = tableOf(report);
    CHECK(std::ranges::count(table, '\n') == 4 + 6);  // All pairs and unsampled ones, of texels.
    CHECK(table.find("published") != std::string::npos);
}

TEST_CASE("a material that does not change is reconstructed without error") {
    const TemporaryFolder folder;
    SyntheticBtf btf = smallBtf();
    btf.value = [](const LightAndView&, int, int) { return Rgb{0.2F, 0.3F, 0.4F}; };
    writeSyntheticBtf(folder.path() / "btf", btf);
    const auto result = evaluate(optionsFor(folder.path() / "btf"), {})["results"][0];
    CHECK(result["delta_e"].get<double>() < 1e-3);
    CHECK(result["highlight"]["delta_e"].get<double>() < 1e-3);
    CHECK(result["psnr"].get<double>() > 90);
}

TEST_CASE("impossible evaluations are refused before an image is read") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = smallBtf();
    writeSyntheticBtf(folder.path() / "btf", btf);
    EvaluateOptions options = optionsFor(folder.path() / "btf");
    options.methods = {"magic"};
    CHECK_THROWS_AS(evaluate(options, {}), std::invalid_argument);
    options = optionsFor(folder.path() / "btf");
    for (const double exposure : {0.0, -1.0, std::nan("")}) {
        options.exposure = exposure;
        CHECK_THROWS_AS(evaluate(options, {}), std::invalid_argument);
    }
    options = optionsFor(folder.path() / "btf");
    options.sheet = folder.path() / "absent" / "sheet.png";
    CHECK_THROWS_AS(evaluate(options, {}), std::runtime_error);
    options = optionsFor(folder.path() / "btf");
    options.texels = {3, 1};
    CHECK_THROWS_AS(evaluate(options, {}), std::invalid_argument);
    // A comparison with the full measurement needs it in full.
    fs::remove(folder.path() / "btf" / syntheticFile(btf, 1295));
    CHECK_THROWS_AS(evaluate(optionsFor(folder.path() / "btf"), {}), std::runtime_error);
}

TEST_CASE("on request missing images are interpolated, and left out of the comparison") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = smallBtf();
    writeSyntheticBtf(folder.path() / "btf", btf);
    for (std::size_t pair = 100; pair < 1296; pair += 100) {
        fs::remove(folder.path() / "btf" / syntheticFile(btf, pair));
    }
    EvaluateOptions options = optionsFor(folder.path() / "btf");
    options.input.missing = MissingImages::kFill;
    options.methods = {"measured"};
    const auto result = evaluate(options, {})["results"][0];
    CHECK(result["pairs"] == 1296 - 12);
    CHECK(result["delta_e"] == 0.0);
}

TEST_SUITE_END();
