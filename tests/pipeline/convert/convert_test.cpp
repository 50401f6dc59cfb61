// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert.h"

#include "abrdf/for_each_texel.h"
#include "color/delta_e.h"
#include "pipeline/evaluate/evaluate.h"
#include "pipeline/inspect/inspect.h"
#include "stages/read/atlas_reader.h"
#include "stages/slice/choose_samples.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

SyntheticBtf cloth(int width, int height, const std::string& extension) {
    SyntheticBtf btf;
    btf.width = width;
    btf.height = height;
    btf.extension = extension;
    btf.value = [](const LightAndView& p, int x, int y) {
        const double c = 0.3 + 0.2 * std::cos(p.light.theta) +
                         0.1 * std::sin(p.light.phi - 2 * p.view.phi) * std::sin(p.view.theta);
        return Rgb{static_cast<float>(c), static_cast<float>(c * (x + 1) / 8),
                   static_cast<float>(c * (y + 1) / 8)};
    };
    return btf;
}

ConvertOptions jobOn(const fs::path& input, const fs::path& output) {
    ConvertOptions options;
    options.input.input = input;
    options.output = output;
    options.method.name = "published";
    return options;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("only the images that the plan needs are opened") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = cloth(2, 2, "png");
    writeSyntheticBtf(folder.path() / "btf", btf);
    const SampleSet samples = chooseSamples(posterPlan({}), btf.grid, SampleWish::kSlices);
    std::size_t kept = 0;
    for (std::size_t pair = 0; pair < btf.grid.pairCount(); ++pair) {
        // Pair 0 tells the images' size; it is read at opening.
        if (pair == 0 || std::ranges::binary_search(samples.pairs, pair)) {
            ++kept;
        } else {
            std::ofstream(folder.path() / "btf" / syntheticFile(btf, pair)) << "garbage";
        }
    }
    CHECK(kept < 500);
    const auto report = convert(jobOn(folder.path() / "btf", folder.path() / "a.exr"), {});
    CHECK(report["plan"]["images_read"] == samples.pairs.size());
    CHECK(report["plan"]["samples"] == 204);
    const auto inspected = inspect(folder.path() / "btf", {});
    CHECK(inspected["unreadable"].size() == 6561 - kept);
    CHECK(inspected["complete"] == false);
}

TEST_CASE("a constant stack is a constant atlas through JPEG, colour and half") {
    const TemporaryFolder folder;
    SyntheticBtf btf = cloth(8, 8, "jpg");
    btf.value = [](const LightAndView&, int, int) { return Rgb{0.5F, 0.5F, 0.5F}; };
    writeSyntheticBtf(folder.path() / "btf", btf);
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.texels = {2, 2};
    convert(options, {});
    const Atlas atlas = readAtlas(options.output);
    const double expected = linearFromSrgb(128.0 / 255);
    for (int light = 0; light < 81; ++light) {
        for (int view = 0; view < 81; ++view) {
            const Rgb c = atlas.at({1, 0, light, view});
            CHECK(static_cast<double>(c.r) == doctest::Approx(expected).epsilon(6e-4));
            CHECK(c.r == c.b);
        }
    }
}

TEST_CASE("measured is the identity on the input's grid, texel by texel") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = cloth(3, 2, "exr");
    writeSyntheticBtf(folder.path() / "btf", btf);
    for (const AtlasKind layout : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
        options.method.name = "measured";
        options.texels = {0, 0};
        options.pixel = PixelChoice::kFloat;
        options.layout = layout;
        convert(options, {});
        const Atlas atlas = readAtlas(options.output);
        for (std::size_t pair = 0; pair < 6561; pair += 13) {
            const LightAndView p = btf.grid.pair(pair);
            CHECK(lookUp(atlas, p.light, p.view, 2, 1) == btf.value(p, 2, 1));
        }
    }
}

TEST_CASE("missing images end the job, unless they are to be filled") {
    const TemporaryFolder folder;
    const SyntheticBtf btf = cloth(1, 1, "png");
    writeSyntheticBtf(folder.path() / "btf", btf);
    const SampleSet samples = chooseSamples(posterPlan({}), btf.grid, SampleWish::kSlices);
    for (std::size_t i = 0; i < 7; ++i) {
        fs::remove(folder.path() / "btf" / syntheticFile(btf, samples.pairs[40 * i]));
    }
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    std::ofstream(options.output) << "old";
    try {
        convert(options, {});
        FAIL("a job without its images passed");
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        CHECK(text.find("7 of the images") != std::string::npos);
        CHECK(text.find("--missing fill") != std::string::npos);
        CHECK(text.find("tl") != std::string::npos);
    }
    CHECK(bytesOf(options.output) == "old");
    options.input.missing = MissingImages::kFill;
    CHECK(convert(options, {})["counts"]["missing"] == 7);
}

TEST_CASE("values that no half can hold choose float, NaN pixels are counted and kept out") {
    const TemporaryFolder folder;
    SyntheticBtf btf = cloth(2, 1, "exr");
    btf.value = [](const LightAndView&, int x, int) {
        const float v = x == 0 ? 1e5F : std::nanf("");
        return Rgb{v, v, v};
    };
    writeSyntheticBtf(folder.path() / "btf", btf);
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    const auto report = convert(options, {});
    CHECK(report["output"]["pixel"] == "float");
    CHECK(report["counts"]["nonfinite"] == report["plan"]["images_read"]);
    CHECK(readAtlas(options.output).at({0, 0, 5, 5}).g == doctest::Approx(1e5));
    options.pixel = PixelChoice::kHalf;
    CHECK(convert(options, {})["counts"]["clamped"] == 6561);
}

TEST_CASE("grids, cosine and output space are those asked for") {
    const TemporaryFolder folder;
    SyntheticBtf btf = cloth(1, 1, "exr");
    btf.value = [](const LightAndView& p, int, int) {
        const auto c = static_cast<float>(std::cos(p.light.theta));
        return Rgb{c, c, c};
    };
    writeSyntheticBtf(folder.path() / "btf", btf);
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
    options.method.name = "measured";
    options.grid = "utia288";
    options.divideCosine = true;
    options.outputSpace = "ACEScg";
    convert(options, {});
    const Atlas atlas = readAtlas(options.output);
    CHECK(atlas.header().layout.width() == 288);
    CHECK(atlas.header().cosine == Cosine::kDivided);
    CHECK(atlas.header().interopId == "lin_ap1_scene");
    for (int light = 0; light < 288; light += 31) {
        CHECK(atlas.at({0, 0, light, 100}).g == doctest::Approx(1).epsilon(2e-3));
    }
}

TEST_CASE("published on the mean of twill and carpet is as accurate as its prototype") {
    struct Known {
        const char* table;
        double deltaE;
    };
    for (const auto& [table, deltaE] : {Known{"virtual/twill_mean_f32.bin", 2.26},
                                        Known{"measured81/ubo2014_carpet07_f32.bin", 2.26}}) {
        const std::vector<Rgb> values = sharedTable(table);
        if (values.empty()) {
            MESSAGE("skipped: ../shared/data/", table, " is absent");
            continue;
        }
        const TemporaryFolder folder;
        SyntheticBtf btf;
        btf.value = [&](const LightAndView& p, int, int) {
            return values[btf.grid.pairIndex(nearestDirection(btf.grid.lights(), p.light),
                                             nearestDirection(btf.grid.views(), p.view))];
        };
        writeSyntheticBtf(folder.path() / "btf", btf);
        EvaluateOptions options;
        options.input.input = folder.path() / "btf";
        options.methods = {"measured", "published"};
        const auto results = evaluate(options, {})["results"];
        CHECK(results[0]["delta_e"] == 0.0);
        CHECK(results[1]["delta_e"].get<double>() == doctest::Approx(deltaE).epsilon(0.02));
    }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("threads");

TEST_CASE("the atlas has the same bytes on 1, 2 and 7 threads, and twice in a row") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", cloth(5, 3, "jpg"));
    for (const AtlasKind layout : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
        std::string first;
        for (const int threads : {1, 2, 7, 7}) {
            const ThreadLimit limit(threads);
            ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "a.exr");
            options.texels = {0, 0};
            options.layout = layout;
            convert(options, {});
            const std::string bytes = bytesOf(options.output);
            if (first.empty()) first = bytes;
            CHECK(bytes == first);
        }
    }
}

TEST_CASE("an atlas wider than 32,768 pixels is written and read") {
    const TemporaryFolder folder;
    SyntheticBtf btf = cloth(1400, 1, "exr");
    btf.grid = gridFromName("regular:4x6");
    btf.value = [](const LightAndView& p, int x, int) {
        const double c = 0.1 + 0.8 * x / 1400 * std::cos(p.light.theta);
        return Rgb{static_cast<float>(c), static_cast<float>(c / 2), 0.1F};
    };
    writeSyntheticBtf(folder.path() / "btf", btf);
    ConvertOptions options = jobOn(folder.path() / "btf", folder.path() / "wide.exr");
    options.method.name = "measured";
    options.texels = {0, 0};
    convert(options, {});
    const Atlas atlas = readAtlas(options.output);
    CHECK(atlas.header().layout.width() == 1400 * 24);
    for (const int x : {0, 700, 1399}) {
        const Rgb value = atlas.at({x, 0, 13, 20});
        const LightAndView pair = btf.grid.pair(btf.grid.pairIndex(13, 20));
        CHECK(value.r == doctest::Approx(btf.value(pair, x, 0).r).epsilon(0.02));
    }
}

TEST_SUITE_END();
