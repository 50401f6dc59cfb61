// SPDX-License-Identifier: BSD-3-Clause
#include "abrdf/discrepancy_kernel.h"

#include "abrdf/angular_grid.h"
#include "abrdf/pair_features.h"

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include <cmath>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("the discrepancy kernel is a correlation, the same for isotropic twins of class iso") {
    const std::vector<LightAndView> pairs = pairsOf(AngularGrid(regularDirections(3, 4)));
    for (const MaterialClass materialClass : {MaterialClass::kIso, MaterialClass::kWoven}) {
        const Eigen::MatrixXd kernel = discrepancyKernel(materialClass, pairs, pairs, 0.6);
        CHECK((kernel - kernel.transpose()).cwiseAbs().maxCoeff() < 1e-6);
        CHECK((kernel.diagonal().array() - 1).abs().maxCoeff() < 1e-6);
        CHECK(kernel.minCoeff() >= 0);
        CHECK(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(kernel).eigenvalues()(0) > -1e-6);
    }
    const LightAndView here = {{0.5, 0.2}, {0.8, 1.4}};
    const LightAndView turned = {{0.5, 2.2}, {0.8, 3.4}};
    CHECK(discrepancyKernel(MaterialClass::kIso, {here}, {turned}, 0.6)(0) ==
          doctest::Approx(1).epsilon(1e-6));
    CHECK(discrepancyKernel(MaterialClass::kAniso, {here}, {turned}, 0.6)(0) < 0.8);
}

TEST_CASE("features are the half angle, the difference angle and the elevations") {
    const LightAndView mirror = {{0.5, 0}, {0.5, kPi}};
    const Eigen::MatrixXd features = isotropicFeatures(std::vector{mirror});
    CHECK(features(0, 0) == doctest::Approx(std::log(2.0)));
    CHECK(features(0, 1) == doctest::Approx(degreesFromRadians(0.5) / 40));
    CHECK(features(0, 2) == doctest::Approx(0.5));
    CHECK(features(0, 3) == doctest::Approx(0.5));
}

TEST_CASE("isotropic twins are found by what turns and mirrors keep") {
    const std::vector<LightAndView> pairs = {{{0.5, 0}, {0.8, 1}}, {{0.5, 2}, {0.8, 3}},
                                             {{0.5, 1}, {0.8, 0}}, {{0.8, 0}, {0.5, 1}},
                                             {{0, 0}, {0.8, 1}},   {{0, 2}, {0.8, 5}}};
    const PairGroups isotropic = isotropicPairs(pairs);
    CHECK(isotropic.rowOf == std::vector<std::size_t>{0, 0, 0, 1, 2, 2});
    CHECK(isotropic.distinct.size() == 3);
    // 762 where azimuths at the pole are told apart.
    CHECK(isotropicPairs(pairsOf(AngularGrid(ubo81Directions()))).distinct.size() == 682);
}

TEST_SUITE_END();
