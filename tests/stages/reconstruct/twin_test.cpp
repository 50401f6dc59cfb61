// SPDX-License-Identifier: BSD-3-Clause
//
// Answers beside those of the same equations in longer floats, and systems that cannot be solved.
#include "stages/measure/measures.h"
#include "stages/reconstruct/rbf_weights.h"
#include "stages/reconstruct/reconstructor.h"
#include "stages/slice/choose_samples.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

using namespace abrdf;

namespace {

Rgb greyPlastic(const LightAndView& pair) {
    const float value = plastic(pair).r;
    return {value, value, value};
}

ReconstructionTask taskOf(const Method& method) {
    const SmallPrior& prior = smallPrior();
    ReconstructionTask task;
    task.input = task.output = prior.grid;
    task.samples =
        method.wish == SampleWish::kSlices ? exactSamples(task.plan.samples()) : prior.samples;
    if (method.needsPrior) task.prior = prior.model;
    for (const LightAndView& pair : task.samples.directions) {
        task.mean.push_back(greyPlastic(pair));
    }
    return task;
}

/// Root of summed squares of an answer's difference from its twin's, relative to that.
double differenceOf(const Method& method, double& condition) {
    const ReconstructionTask task = taskOf(method);
    std::vector<Rgb> abrdf(task.output.pairCount());
    method.make(task)->reconstruct(task.mean, abrdf);
    const TwinAnswer twin = method.twin(task);
    condition = twin.condition;
    double off2 = 0;
    double sum2 = 0;
    for (std::size_t i = 0; i < abrdf.size(); ++i) {
        off2 += std::pow(static_cast<double>(abrdf[i].g) - twin.abrdf[i][1], 2);
        sum2 += std::pow(twin.abrdf[i][1], 2);
    }
    return std::sqrt(off2 / sum2);
}

}  // namespace

TEST_SUITE_BEGIN("unit");

TEST_CASE("every method that solves a system is its twin in longer floats, but for rounding") {
    std::string withTwin;
    for (const Method& method : methods()) {
        if (method.twin == nullptr) continue;
        const std::string name = method.name;
        withTwin += name + " ";
        CAPTURE(name);
        double condition = 0;
        const double difference = differenceOf(method, condition);
        CHECK(difference < 1e-4);
        CHECK(condition > 2);
    }
    CHECK(withTwin == "prior published rbf microfacet ");
}

TEST_CASE("a system that is singular is named, with its number and the remedy") {
    ReconstructionTask task = taskOf(methodFromName("rbf"));
    task.samples.directions[3].light.theta = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(methodFromName("rbf").make(task), doctest::Contains("condition number"),
                         std::invalid_argument);

    Eigen::MatrixX2d line(4, 2);
    line << 0.1, 0.2, 0.2, 0.4, 0.3, 0.6, 0.4, 0.8;
    CHECK_THROWS_WITH_AS(RbfWeights{line}, doctest::Contains("1e-10 is needed"),
                         std::invalid_argument);

    task = taskOf(methodFromName("prior"));
    PriorModel broken = *task.prior;
    for (PriorClass& priorClass : broken.classes) {
        for (PriorSpectrum& spectrum : priorClass.spectra) spectrum.eigenvalues(0) = -2;
    }
    task.prior = std::make_shared<const PriorModel>(broken);
    CHECK_THROWS_WITH_AS(methodFromName("prior").make(task), doctest::Contains("train it anew"),
                         std::invalid_argument);
}

TEST_CASE("samples at one place do not make rbf's system singular") {
    ReconstructionTask task = taskOf(methodFromName("rbf"));
    const std::vector<LightAndView> once = task.samples.directions;
    task.samples.directions.insert(task.samples.directions.end(), once.begin(), once.end());
    const auto reconstructor = methodFromName("rbf").make(task);
    CHECK(reconstructor->condition() > 1e5);
    CHECK(reconstructor->condition() < 1e10);
}

TEST_SUITE_END();
