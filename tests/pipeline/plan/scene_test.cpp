// SPDX-License-Identifier: BSD-3-Clause
//
// A conversion for what a scene shows: its grid, its samples, its errors, and what it does not
// read.
#include "abrdf/scene_pairs.h"
#include "pipeline/convert/convert.h"
#include "pipeline/evaluate/evaluate.h"
#include "pipeline/plan/plan.h"
#include "pipeline/plan/plan_file.h"
#include "pipeline/plan/scene_plan.h"
#include "pipeline/train/error_scale.h"
#include "stages/measure/measures.h"
#include "stages/read/atlas_reader.h"
#include "stages/reconstruct/prior_material.h"
#include "stages/slice/choose_samples.h"
#include "stages/train/train_prior.h"
#include "tests/support/measured_materials.h"
#include "tests/support/small_prior.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <tuple>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// The camera goes over the material in steps, one arc for each of three lights.
fs::path arcFile(const TemporaryFolder& folder, double step) {
    const fs::path file = folder.path() / "arc.csv";
    std::ofstream stream(file);
    stream << "theta_i,phi_i,theta_v,phi_v,weight\n";
    for (const auto& [theta, phi] : {std::pair{30, 0}, {45, 120}, {60, 252}}) {
        for (int k = -4; k <= 4; ++k) {
            stream << fmt::format("{},{},{},{},{}\n", theta, phi, std::abs(k) * step,
                                  k < 0 ? 240 : 60, k == 0 ? 2 : 1);
        }
    }
    return file;
}

fs::path plasticBtf(const TemporaryFolder& folder) {
    SyntheticBtf btf;
    btf.grid = AngularGrid(regularDirections(5, 12));
    btf.value = [](const LightAndView& pair, int, int) { return plastic(pair); };
    writeSyntheticBtf(folder.path() / "btf", btf);
    return folder.path() / "btf";
}

ConvertOptions jobOn(const fs::path& input, const TemporaryFolder& folder) {
    ConvertOptions options;
    options.input.input = input;
    options.output = folder.path() / "atlas.exr";
    options.method.prior.train.materials = 60;
    return options;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a scene's atlas holds its own directions, from fewer images, near the truth") {
    const TemporaryFolder folder;
    ConvertOptions options = jobOn(plasticBtf(folder), folder);
    options.pairs = arcFile(folder, 13);
    const auto report = convert(options, {});
    const Atlas atlas = readAtlas(options.output);
    CHECK(atlas.header().grid.lights().size() == 3);
    CHECK(atlas.header().grid.views().size() == 9);
    CHECK(report["scene"]["pairs"] == 27);
    CHECK(report["scene"]["outputs"]["reconstructed"] == 27);
    CHECK(report["scene"]["outputs"]["without"] == 3600);
    CHECK(report["scene"]["images"]["read"] == report["plan"]["images_read"]);
    CHECK(report["plan"]["images_read"] < 60);
    std::vector<Rgb> truth;
    for (const LightAndView& pair : pairsOf(atlas.header().grid)) truth.push_back(plastic(pair));
    CHECK(measureAccuracy(truth, atlas.pixels(), {}, {}).natural.deltaE < 1.5);
}

TEST_CASE("where what a scene shows was measured, it is read, and comes back") {
    const TemporaryFolder folder;
    ConvertOptions options = jobOn(plasticBtf(folder), folder);
    const fs::path file = folder.path() / "one.csv";
    std::ofstream(file) << "18.75,30,37.5,60\n37.5,90,0,0\n56.25,120,37.5,60,3\n";
    options.pairs = file;
    const auto report = convert(options, {});
    CHECK(report["plan"]["images_read"] <= 8);
    CHECK(report["scene"]["expected_delta_e"].get<double>() < 0.5);
}

TEST_CASE("a measured scene reads what its interpolation needs, and gives what all images give") {
    const TemporaryFolder folder;
    ConvertOptions options = jobOn(plasticBtf(folder), folder);
    options.method.name = "measured";
    options.pairs = arcFile(folder, 13);
    const auto report = convert(options, {});
    const auto read = report["plan"]["images_read"].get<std::size_t>();
    CHECK(read < 1200);
    CHECK(report["scene"]["images"]["without"] == 3600);
    const Atlas some = readAtlas(options.output);
    const PairInterpolation all{AngularGrid(regularDirections(5, 12))};
    std::vector<Rgb> values;
    for (const LightAndView& p : pairsOf(AngularGrid(regularDirections(5, 12)))) {
        values.push_back(plastic(p));
    }
    for (std::size_t i = 0; i < some.header().grid.pairCount(); ++i) {
        CHECK(some.pixels()[i].g ==
              doctest::Approx(all.value(some.header().grid.pair(i), values).g).epsilon(1e-3));
    }
}

TEST_CASE("another scene is another job; the same one is resumed") {
    const TemporaryFolder folder;
    ConvertOptions options = jobOn(plasticBtf(folder), folder);
    options.pairs = arcFile(folder, 13);
    options.resume = true;
    convert(options, {});
    CHECK(convert(options, {}).contains("finished_before"));
    // The same directions, weighed otherwise.
    const fs::path other = folder.path() / "other.csv";
    std::ifstream in(options.pairs);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    text.replace(text.rfind(",1"), 2, ",9");
    std::ofstream(other) << text;
    options.pairs = other;
    CHECK_THROWS_WITH_AS(convert(options, {}), doctest::Contains("is of another job"),
                         std::runtime_error);
}

TEST_CASE("evaluate counts what a scene shows, and a plan for it is better there") {
    const TemporaryFolder folder;
    EvaluateOptions options;
    options.input.input = plasticBtf(folder);
    options.methods = {"prior"};
    options.choice.prior.train.materials = 60;
    options.pairs = arcFile(folder, 18.75);
    const auto own = evaluate(options, {});
    CHECK(own["scene"] == "arc.csv");
    options.choice.plan.name = "eight";
    const auto eight = evaluate(options, {});
    CHECK(own["results"][0]["samples"] < eight["results"][0]["samples"]);
    CHECK(own["results"][0]["delta_e"] < eight["results"][0]["delta_e"]);
    options.pairs.clear();
    CHECK(evaluate(options, {})["results"][0]["delta_e"] != eight["results"][0]["delta_e"]);
}

TEST_CASE("abrdf plan chooses for a scene, and expects less error there from fewer samples") {
    const TemporaryFolder folder;
    PlanJob job;
    job.grid = "regular:5x12";
    job.samples = 20;
    job.materials = 30;
    job.output = folder.path() / "plan.toml";
    const auto whole = plan(job, {});
    job.pairs = arcFile(folder, 13);
    const auto scene = plan(job, {});
    CHECK(scene["plan"]["name"] == "greedy-arc");
    CHECK(scene["expected_error"].back() < whole["expected_error"].back());
    CHECK(planFromFile(job.output).samples.size() == 20);
}

TEST_SUITE_END();
TEST_SUITE_BEGIN("slow");

namespace {

/// Of UBO2003's grid.
struct Scene {
    const char* name;
    std::vector<std::size_t> lights;
    std::vector<std::size_t> views;
};

std::vector<std::size_t> all81() {
    std::vector<std::size_t> indices(81);
    std::iota(indices.begin(), indices.end(), std::size_t{0});
    return indices;
}

/// Three lights, at 30, 45 and 60 degrees; a camera that goes over the material from -75 to 75
/// degrees; both anywhere.
std::vector<Scene> scenes() {
    const AngularGrid grid(ubo81Directions());
    const auto at = [&](double theta, double phi) {
        return nearestDirection(grid.lights(),
                                {radiansFromDegrees(theta), radiansFromDegrees(phi)});
    };
    const std::vector<std::size_t> lights = {at(30, 0), at(45, 120), at(60, 252)};
    std::vector<std::size_t> arc;
    for (int k = -5; k <= 5; ++k) arc.push_back(at(15 * std::abs(k), k < 0 ? 240 : 60));
    return {{"three lights, a camera's arc", lights, arc},
            {"three lights, all views", lights, all81()},
            {"all lights, one view", all81(), {at(0, 0)}},
            {"all lights, a camera's arc", all81(), arc}};
}

/// Mean Delta E over a scene of a plan, each material's mean and the worst.
struct SceneError {
    std::size_t samples = 0;
    double mean = 0;
    double worst = 0;
    std::size_t obeyed = 0;
};

SceneError errorOf(const SamplePlan& plan, const Scene& scene,
                   const std::vector<std::vector<Rgb>>& tables) {
    const AngularGrid grid(ubo81Directions());
    const SampleSet samples = chooseSamples(plan, grid, SampleWish::kMeasuredPairs);
    std::vector<LightAndView> outputs;
    std::vector<std::size_t> pairs;
    for (const std::size_t l : scene.lights) {
        for (const std::size_t v : scene.views) {
            pairs.push_back(grid.pairIndex(l, v));
            outputs.push_back(grid.pair(pairs.back()));
        }
    }
    PriorModel model = trainPrior(samples.directions, outputs, {}, {});
    model.errorScale = learnErrorScale(model, 1);
    std::vector<std::size_t> rows(outputs.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    SceneError result{samples.count()};
    for (const std::vector<Rgb>& table : tables) {
        std::vector<Rgb> values;
        for (const std::size_t pair : samples.pairs) values.push_back(table[pair]);
        std::vector<Rgb> truth;
        for (const std::size_t pair : pairs) truth.push_back(table[pair]);
        std::vector<Rgb> abrdf(outputs.size());
        const PriorMaterial material(model, rows, values, {});
        material.reconstruct(values, abrdf);
        float bound = 0;
        material.encode(values, {&bound, 1});
        const double error = measureAccuracy(truth, abrdf, {}, {}).natural.deltaE;
        result.mean += error / static_cast<double>(tables.size());
        result.worst = std::max(result.worst, error);
        result.obeyed += error <= static_cast<double>(bound) ? 1U : 0U;
    }
    return result;
}

SceneOutputs outputsOf(const Scene& scene) {
    const auto count = static_cast<double>(scene.lights.size() * scene.views.size());
    return {"scene", std::vector<double>(static_cast<std::size_t>(count), 1 / count)};
}

AngularGrid gridOf(const Scene& scene) {
    const std::vector<Direction> all = ubo81Directions();
    std::vector<Direction> lights;
    std::vector<Direction> views;
    for (const std::size_t l : scene.lights) lights.push_back(all[l]);
    for (const std::size_t v : scene.views) views.push_back(all[v]);
    return {lights, views};
}

}  // namespace

TEST_CASE("on measured materials a plan for a scene beats plans for all directions there") {
    const auto tables = measuredMaterials();
    if (tables.empty()) {
        MESSAGE("skipped: there are no measured materials beside this checkout");
        return;
    }
    const AngularGrid grid(ubo81Directions());
    for (const Scene& scene : scenes()) {
        const auto planned = [&](const ScenePlanOptions& options) {
            return scenePlan(outputsOf(scene), gridOf(scene), grid, {}, options, {}, {});
        };
        const ScenePlan own = planned({});
        const ScenePlan tolerant = planned({.tolerance = 1});
        const std::size_t count = own.plan.samples.size();
        const std::vector<std::size_t>& greedy = greedyPairsOfUbo81();
        const auto prefix = [&](std::size_t n) {
            return pairsPlan("greedy", grid,
                             {greedy.begin(), greedy.begin() + static_cast<long>(n)});
        };
        const SceneError ofOwn = errorOf(own.plan, scene, tables);
        const SceneError ofEight = errorOf(eightPlan(0, &grid), scene, tables);
        const SceneError ofSame = errorOf(prefix(count), scene, tables);
        for (const auto& [name, error, expected] :
             {std::tuple{"its own", ofOwn, own.expectedError},
              {"its own, --tolerance 1", errorOf(tolerant.plan, scene, tables),
               tolerant.expectedError},
              {"greedy, as many", ofSame, 0.0},
              {"greedy", errorOf(prefix(204), scene, tables), 0.0},
              {"eight", ofEight, 0.0}}) {
            MESSAGE(fmt::format("{} | {} | {} | {:.2f} | {:.2f} | {} of {} | {:.2f}", scene.name,
                                name, error.samples, error.mean, error.worst, error.obeyed,
                                tables.size(), expected));
        }
        CHECK(count <= 204);
        CHECK(ofOwn.mean < ofSame.mean);
        CHECK(ofOwn.mean < ofEight.mean);
    }
}

TEST_SUITE_END();
