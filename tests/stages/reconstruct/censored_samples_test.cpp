// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/censored_samples.h"

#include "stages/reconstruct/prior_encoder.h"
#include "tests/support/small_prior.h"

#include <doctest/doctest.h>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a clipped highlight is put back above the clip, and no other sample is touched") {
    const PriorModel& model = *smallPrior().model;
    const Eigen::MatrixX3d whole = matrixOf(smallPrior().samplesOf(plastic));
    const Eigen::MatrixX3d clipped = whole.cwiseMin(0.6);
    REQUIRE(clipped != whole);
    const auto terms = chooseTerms(model, clipped.rowwise().sum() / 3, 0);
    const Eigen::MatrixX3d restored = CensoredSamples(model, terms, 0.6).restored(clipped);
    for (Eigen::Index row = 0; row < clipped.rows(); ++row) {
        if (clipped.row(row).maxCoeff() < 0.6) {
            CHECK(restored.row(row) == clipped.row(row));
        } else {
            CHECK(restored.row(row).sum() >= clipped.row(row).sum() - 1e-9);
        }
    }
    CHECK(restored.sum() > 1.01 * clipped.sum());
    const Eigen::MatrixX3d all = Eigen::MatrixX3d::Ones(clipped.rows(), 3);
    CHECK(CensoredSamples(model, terms, 0.6).restored(all) == all);
}

TEST_SUITE_END();
