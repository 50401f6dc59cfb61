// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/prior_choice.h"

#include "stages/reconstruct/prior_encoder.h"
#include "tests/support/small_prior.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("samples predict one another as if each had been left out") {
    const PriorModel& model = *smallPrior().model;
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const Eigen::VectorXd green = matrixOf(samples).col(1);
    const std::vector<PriorTerm> terms = {{false, 1, 2, 3e-3, 1}};
    const Eigen::VectorXd predicted = leaveOneOut(model, terms, green);
    const LogSamples logs = logSamples(model, green);
    const PriorClass& c = model.classes[1];
    const Eigen::MatrixXd covariance = precisionOf(model, terms[0]).inverse();
    for (const Eigen::Index left : {0, 7, 30}) {
        std::vector<Eigen::Index> others(static_cast<std::size_t>(green.size()));
        std::iota(others.begin(), others.end(), Eigen::Index{0});
        others.erase(others.begin() + left);
        const Eigen::VectorXd centered = logs.z - c.sampleMean;
        const Eigen::RowVectorXd toOthers = covariance(left, others);
        const Eigen::MatrixXd between = covariance(others, others);
        const Eigen::VectorXd known = centered(others);
        const double z = c.sampleMean(left) + (toOthers * between.llt().solve(known)).value();
        const double value = std::max(std::exp(z) - kPriorFloor, 0.0) * logs.scale;
        CHECK(predicted(left) == doctest::Approx(value).epsilon(1e-6));
    }
}

TEST_CASE("a model for fewer samples is the model trained for them") {
    const PriorModel& model = *smallPrior().model;
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < model.samples.size(); ++k) {
        if (k % 3 != 1) kept.push_back(k);
    }
    const PriorModel fewer = withSamples(model, kept);
    REQUIRE(fewer.samples.size() == kept.size());
    const auto spectrumOf = [](const PriorModel& m, std::size_t c, std::size_t s) {
        return precisionOf(m, {false, c, s, 1e-2, 1}).inverse().eval();
    };
    for (const std::size_t spectrum : {0U, 5U}) {
        const Eigen::MatrixXd whole = spectrumOf(model, 2, spectrum);
        const Eigen::MatrixXd part = whole(kept, kept);
        CHECK((spectrumOf(fewer, 2, spectrum) - part).norm() < 1e-6 * part.norm());
    }
    CHECK(fewer.classes[2].cross.col(1) ==
          model.classes[2].cross.col(static_cast<Eigen::Index>(kept[1])));
}

TEST_SUITE_END();
