// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/chart/chart.h"

#include "pipeline/chart/method_limits.h"
#include "tests/support/synthetic_btf.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace abrdf;
namespace fs = std::filesystem;

namespace {

/// A matt material, so that Lambert's law is right.
fs::path mattDatabase(const TemporaryFolder& folder) {
    SyntheticBtf btf;
    btf.value = [](const LightAndView& pair, int, int) {
        const auto value = static_cast<float>(0.5 * std::cos(pair.light.theta));
        return Rgb{value, value, value};
    };
    writeSyntheticBtf(folder.path() / "matt", btf);
    return folder.path() / "matt";
}

MethodFigure figure(const char* method, std::size_t samples, int rank, double deltaE, double time) {
    MethodFigure f;
    f.size = {method, samples, rank};
    f.deltaE = deltaE;
    f.microseconds = time;
    return f;
}

const std::vector<MethodFigure>& someFigures() {
    static const std::vector<MethodFigure> kFigures = {
        figure("constant", 16, 0, 9, 10), figure("idw", 204, 0, 4, 20),
        figure("prior", 52, 0, 2, 150), figure("prior", 204, 8, 1.6, 80),
        figure("prior", 204, 0, 0.9, 400)};
    return kFigures;
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("a chart tells of every method and size what it costs and how far off it is") {
    const TemporaryFolder folder;
    ChartOptions options;
    options.inputs.resize(1);
    options.inputs[0].input = mattDatabase(folder);
    options.methods = {"measured", "published", "idw", "constant"};
    options.samples = {16, 52};
    options.csv = folder.path() / "chart.csv";
    options.trial.seconds = 0;
    const auto report = chart(options, {}, {});
    CHECK(report["results"].size() == 6);  // `measured` has no size, and is never wrong.
    for (const auto& r : report["results"]) {
        CHECK(r["input"] == "matt");
        CHECK(r["microseconds_per_abrdf"] > 0);
        CHECK(r["microseconds_all_cores"] > 0);
        CHECK(r["multiply_adds"] > 0);
        CHECK(r["model_bytes"] > 0);
        if (r["method"] == "constant") {
            CHECK(r["delta_e"] < 1e-3);
            CHECK(r["model_bytes"] == 12);
        }
        // It interpolates what the cosine is taken out of.
        if (r["method"] == "idw") CHECK(r["delta_e"] < 1e-3);
        if (r["method"] == "published") CHECK(r["delta_e"] > 0.1);
    }
    const std::string csv = bytesOf(options.csv);
    const std::vector<MethodFigure> figures = figuresFromCsv(csv, "chart.csv");
    CHECK(figures.size() == 6);
    CHECK(csvOf(figures) == csv);
    CHECK_THROWS_AS(figuresFromCsv(csv + "prior,16\n", "chart.csv"), std::runtime_error);
    CHECK_THROWS_AS(figuresFromCsv("nonsense\n", "chart.csv"), std::runtime_error);
}

TEST_CASE("figures over several materials are means and worst ones") {
    std::vector<Trial> trials(3);
    for (std::size_t i = 0; i < trials.size(); ++i) {
        trials[i].size = {"idw", 16, 0};
        trials[i].accuracy.natural.deltaE = static_cast<double>(i);
        trials[i].accuracy.natural.psnr = 30 - static_cast<double>(i);
        trials[i].time.oneCore = static_cast<double>(i * i);
    }
    const std::vector<MethodFigure> figures = figuresOf(trials);
    REQUIRE(figures.size() == 1);
    CHECK(figures[0].deltaE == doctest::Approx(1));
    CHECK(figures[0].worstDeltaE == doctest::Approx(2));
    CHECK(figures[0].worstPsnr == doctest::Approx(28));
    CHECK(figures[0].microseconds == doctest::Approx(5.0 / 3));
}

TEST_CASE("impossible charts are refused before anything is read") {
    ChartOptions options;
    CHECK_THROWS_AS(chart(options, {}, {}), std::invalid_argument);
    options.inputs.resize(1);
    options.output = "/tmp/chart.pdf";
    CHECK_THROWS_AS(chart(options, {}, {}), std::invalid_argument);
    options.output.clear();
    options.samples = {4};
    CHECK_THROWS_AS(chart(options, {}, {}), std::invalid_argument);
}

TEST_CASE("a budget takes the most accurate within it, a tolerance the fewest samples") {
    const auto choice = [](std::optional<double> budget, std::optional<double> tolerance) {
        return chooseWithin(someFigures(), {budget, tolerance, false, true});
    };
    CHECK(choice(1000, {}).figure.deltaE == 0.9);
    CHECK(choice(100, {}).figure.size.rank == 8);
    CHECK(choice(30, {}).figure.size.method == "idw");
    CHECK(choice({}, 2.0).figure.size.samples == 52);
    CHECK(choice({}, 1.7).figure.size.rank == 8);
    CHECK(choice(100, 2.0).figure.size.samples == 204);
    CHECK(choice(100, 2.0).isMet);
    const LimitedChoice nothing = choice(5, {});
    CHECK(!nothing.isMet);
    CHECK(nothing.figure.size.method == "constant");
    const LimitedChoice tooFine = choice(100, 0.1);
    CHECK(!tooFine.isMet);
    CHECK(tooFine.figure.size.rank == 8);
}

TEST_CASE("what nothing meets is a warning, and an error where the user is strict") {
    MethodChoice method;
    std::string told;
    const auto warn = [&](const std::string& message) { told = message; };
    CHECK(settleMethod(method, {}, 6561, warn).is_null());
    const auto report = settleMethod(method, {{}, 1e-6, false, true}, 6561, warn);
    CHECK(report["met"] == false);
    CHECK(told.find("nothing meets") != std::string::npos);
    CHECK(method.plan.name == report["plan"]);
    MethodChoice other;
    CHECK_THROWS_AS(settleMethod(other, {{}, 1e-6, true, true}, 6561, warn), std::runtime_error);
    CHECK_THROWS_AS(settleMethod(other, {{}, -1.0, false, true}, 6561, warn),
                    std::invalid_argument);
}

TEST_CASE("a method and a plan that the user named stay") {
    MethodChoice choice;
    choice.name = "idw";
    choice.plan.name = "greedy:100";
    const auto report = settleMethod(choice, {1e6, {}, false, false}, 6561, {});
    CHECK(choice.name == "idw");
    CHECK(choice.plan.name == "greedy:100");
    CHECK(report["expected_delta_e"] > 0);
}

TEST_CASE("times are read with their units") {
    CHECK(microsecondsFromText("50us") == 50);
    CHECK(microsecondsFromText("1.5ms") == 1500);
    CHECK(microsecondsFromText("2s") == 2e6);
    for (const char* wrong : {"", "50", "us", "-1us", "1h", "nanus"}) {
        CHECK_THROWS_AS(microsecondsFromText(wrong), std::invalid_argument);
    }
}

TEST_SUITE_END();
