// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/convert/convert.h"
#include "pipeline/convert/expand.h"
#include "stages/read/atlas_reader.h"
#include "stages/read/model_reader.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// Each texel another Lambertian with a little gloss.
SyntheticBtf gloss() {
    SyntheticBtf btf;
    btf.grid = gridFromName("regular:4x6");
    btf.width = 5;
    btf.height = 3;
    btf.extension = "exr";
    btf.value = [](const LightAndView& p, int x, int y) {
        const double lobe = std::exp(-4 * std::pow(p.light.theta - p.view.theta, 2)) *
                            std::max(0.0, -std::cos(p.light.phi - p.view.phi));
        const double c = std::cos(p.light.theta) * (0.1 + 0.05 * x) + 0.02 * y * lobe;
        return Rgb{static_cast<float>(c), static_cast<float>(0.7 * c),
                   static_cast<float>(0.4 * c + 0.01 * lobe)};
    };
    return btf;
}

ConvertOptions jobOn(const fs::path& folder, const fs::path& output) {
    ConvertOptions options;
    options.input.input = folder / "btf";
    options.output = output;
    options.method.plan.name = "greedy:40";
    options.method.prior.train.materials = 60;
    options.texels = {0, 0};
    options.plane.search = false;
    return options;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a model atlas expands to the direct one, in both layouts and at any rank") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", gloss());
    for (const int rank : {0, 6}) {
        ConvertOptions job = jobOn(folder.path(), folder.path() / "direct.exr");
        job.method.options.rank = rank;
        job.pixel = PixelChoice::kFloat;
        if (rank == 0) {
            job.limits.tolerance = 3;
            job.limits.methodIsOpen = false;
        }
        convert(job, {});
        const Atlas direct = readAtlas(job.output);
        job.output = folder.path() / "model.exr";
        job.layout = AtlasKind::kModel;
        convert(job, {});
        const ModelAtlas model = readModelAtlas(job.output);
        CHECK(model.estimates.size() == 15);
        for (const AtlasKind kind : {AtlasKind::kAngular, AtlasKind::kSpatial}) {
            ExpandOptions expanding;
            expanding.input = job.output;
            expanding.output = folder.path() / "expanded.exr";
            expanding.layout = kind;
            expanding.pixel = PixelChoice::kFloat;
            expand(expanding, {});
            const Atlas expanded = readAtlas(expanding.output);
            double worst = 0;
            for (int t = 0; t < 15; ++t) {
                for (int light = 0; light < direct.header().layout.lights; ++light) {
                    for (int view = 0; view < direct.header().layout.views; ++view) {
                        const AtlasSample at{t % 5, t / 5, light, view};
                        worst = std::max(worst, std::abs(static_cast<double>(direct.at(at).g -
                                                                             expanded.at(at).g)));
                    }
                }
            }
            CHECK(worst < 1e-6);
            CHECK(readEstimates(expanding.output) == model.estimates);
        }
        // A look-up at the atlas's own directions is the value there.
        const PairInterpolation interpolation(model.header.grid);
        const LightAndView pair = model.header.grid.pair(77);
        const AtlasSample at{3, 1, static_cast<int>(model.header.grid.lightOf(77)),
                             static_cast<int>(model.header.grid.viewOf(77))};
        CHECK(lookUp(model, interpolation, pair.light, pair.view, 3, 1).g ==
              doctest::Approx(direct.at(at).g));
        CHECK(readAtlas(job.output).at(at).g == doctest::Approx(direct.at(at).g));
        CHECK_THROWS_AS(lookUp(model, interpolation, pair.light, pair.view, 5, 0),
                        std::out_of_range);
    }
}

TEST_CASE("a damaged model atlas and what a model cannot be are refused in a sentence") {
    const TemporaryFolder folder;
    writeSyntheticBtf(folder.path() / "btf", gloss());
    ConvertOptions job = jobOn(folder.path(), folder.path() / "model.exr");
    job.layout = AtlasKind::kModel;
    ConvertOptions wrong = job;
    wrong.method.name = "idw";
    CHECK_THROWS_WITH_AS(convert(wrong, {}), doctest::Contains("few numbers"), std::runtime_error);
    wrong = job;
    wrong.outputSpace = "ACEScg";
    CHECK_THROWS_WITH_AS(convert(wrong, {}), doctest::Contains("abrdf expand"),
                         std::invalid_argument);
    CHECK_FALSE(fs::exists(job.output));
    convert(job, {});
    std::ifstream stream(job.output, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(stream)), {});
    for (const std::size_t cut : {bytes.size() / 2, bytes.size() - 10}) {
        std::ofstream(folder.path() / "cut.exr", std::ios::binary) << bytes.substr(0, cut);
        CHECK_THROWS_AS(readModelAtlas(folder.path() / "cut.exr"), std::runtime_error);
    }
    ExpandOptions expanding;
    expanding.input = job.output;
    expanding.output = job.output;
    CHECK_THROWS_WITH_AS(expand(expanding, {}), doctest::Contains("is the input as well"),
                         std::runtime_error);
}

TEST_SUITE_END();
