// SPDX-License-Identifier: BSD-3-Clause
#include "stages/train/conditioned_class.h"

#include "abrdf/slice.h"

#include <doctest/doctest.h>

#include <vector>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("a block of samples explains what they explain one after the other") {
    const std::vector<LightAndView> samples =
        samplesOf({SliceKind::kDiagonal, 0.5, 0.9, 1, 5, 0, 1.5});
    const AngularGrid grid(regularDirections(3, 5));
    ConditionedClass materials(MaterialClass::kWoven, grid, watchedPairs(grid, 1), samples,
                               {.materials = 30});
    const double block = materials.scoreOf(0, materials.ownCovariance(0, 5));
    double sum = 0;
    for (Eigen::Index k = 0; k < 5; ++k) {
        Eigen::VectorXd score = Eigen::VectorXd::Zero(5);
        materials.addScores(score);
        sum += score(k);
        const double before = materials.varianceLeft();
        materials.choose(k);
        CHECK(materials.varianceLeft() < before);
    }
    CHECK(block == doctest::Approx(sum).epsilon(1e-3));
}

TEST_SUITE_END();
