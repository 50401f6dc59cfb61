// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/leave_out.h"

#include "stages/reconstruct/prior_encoder.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("left-out samples are predicted as by the closed form") {
    const std::vector<Rgb> samples = smallPrior().samplesOf(plastic);
    const PriorModel& model = *smallPrior().model;
    const Eigen::VectorXd luminance = matrixOf(samples).rowwise().sum() / 3;
    const std::vector<PriorTerm> terms = chooseTerms(model, luminance, 0);
    SampleBlocks single;
    for (Eigen::Index k = 0; k < luminance.size(); ++k) single.push_back({k});
    const LeaveOutMap map = leaveOutMap(model, terms, single);
    const LogSamples logs = logSamples(model, luminance);
    const Eigen::VectorXd predicted =
        ((logs.z - (map.matrix * logs.z - map.offset)).array().exp() - kPriorFloor).max(0.0) *
        logs.scale;
    const Eigen::VectorXd closed = leaveOneOut(model, terms, luminance);
    CHECK((predicted - closed).cwiseAbs().maxCoeff() < 1e-9 * closed.maxCoeff());
}

TEST_SUITE_END();
