// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct/low_rank.h"

#include "abrdf/random.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <doctest/doctest.h>

using namespace abrdf;

TEST_SUITE_BEGIN("unit");

TEST_CASE("basis and projection of full rank are the map, and the first numbers are the best") {
    Random random(3);
    Eigen::MatrixXf matrix(40, 9);
    for (float& x : matrix.reshaped()) x = static_cast<float>(random.uniform(-1, 1));
    Eigen::MatrixXd root(9, 9);
    for (double& x : root.reshaped()) x = random.uniform(-1, 1);
    const Eigen::MatrixXd covariance = root * root.transpose() + Eigen::MatrixXd::Identity(9, 9);
    const NestedBasis whole = nestedBasis(matrix, covariance, 9);
    CHECK((whole.basis * whole.projection - matrix).norm() < 1e-4F * matrix.norm());
    // The error of vectors of this covariance: what the singular values say, and no smaller.
    const Eigen::MatrixXd colored =
        matrix.cast<double>() * covariance.llt().matrixL().toDenseMatrix();
    const Eigen::VectorXd values = colored.jacobiSvd().singularValues();
    for (const Eigen::Index r : {2, 5}) {
        const Eigen::MatrixXd left =
            (matrix - whole.basis.leftCols(r) * whole.projection.topRows(r)).cast<double>() *
            covariance.llt().matrixL().toDenseMatrix();
        CHECK(left.squaredNorm() ==
              doctest::Approx(values.tail(9 - r).squaredNorm()).epsilon(1e-3));
    }
}

TEST_CASE("where few outputs matter, as many numbers as those are give these exactly") {
    Random random(4);
    Eigen::MatrixXf matrix(40, 9);
    for (float& x : matrix.reshaped()) x = static_cast<float>(random.uniform(-1, 1));
    const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(9, 9);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(40);
    weights(3) = 0.7;
    weights(20) = 0.2;
    weights(39) = 0.1;
    const NestedBasis few = nestedBasis(matrix, covariance, 3, weights);
    const Eigen::MatrixXf made = few.basis * few.projection;
    for (const Eigen::Index row : {3, 20, 39}) {
        CHECK((made.row(row) - matrix.row(row)).norm() < 1e-4F);
    }
    CHECK((made - matrix).norm() > 1);
    const NestedBasis even = nestedBasis(matrix, covariance, 3, Eigen::VectorXd::Ones(40));
    const NestedBasis plain = nestedBasis(matrix, covariance, 3);
    CHECK((even.basis * even.projection - plain.basis * plain.projection).norm() < 1e-3F);
}

TEST_SUITE_END();
